#pragma once

#include <array>
#include <optional>

#include "passes/common/compute/large_buffer.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/view/surface_motion.h"

namespace voxray {

enum class GBufferMethod { Rays, Raster };

template <>
struct EnumNames<GBufferMethod> {
    static constexpr std::array names{std::pair{GBufferMethod::Rays, "rays"},
                                      std::pair{GBufferMethod::Raster, "raster"}};
};

enum class TextureLookup { Filtered, Sharp };

template <>
struct EnumNames<TextureLookup> {
    static constexpr std::array names{std::pair{TextureLookup::Filtered, "filtered"},
                                      std::pair{TextureLookup::Sharp, "sharp"}};
};

/// How the camera looks at the image plane, as in view.glsl.
struct View {
    glm::vec3 origin;
    uint32_t width;
    glm::vec3 forward;
    uint32_t height;
    glm::vec3 right;
    glm::vec3 up;
};

/// What the camera sees, by camera rays through the stream interface or by raster.
class GBufferPass final : public Pass {
 public:
    static constexpr const char* kName = "gbuffer";
    static constexpr const char* kHelp =
        "Position, normals, albedo and emission of what the camera sees, samples x samples a pixel. Biased "
        "at edges, where the reference averages over the pixel; less so the more samples.";
    struct Params {
        GBufferMethod method = GBufferMethod::Rays;
        uint32_t samplesPerPixelEdge = 1;
        TextureLookup normalMaps = TextureLookup::Filtered;
        TextureLookup colors = TextureLookup::Filtered;
        static constexpr auto schema() {
            return std::tuple{
                field("method", &Params::method,
                      "rays: camera rays, which meet the same surfaces as every other ray; on a CPU a tenth "
                      "of raster's time in a large scene. raster: for GPUs whose rays are slow or missing."),
                field("samples_per_pixel_edge", &Params::samplesPerPixelEdge,
                      "Samples along each edge of a pixel: 2 takes 4 a pixel, on a regular grid. Passes that "
                      "read the g-buffer do their work for each.",
                      1u, 8u),
                field("normal_maps", &Params::normalMaps,
                      "filtered: the mean normal of a sample's footprint, which is flatter than each of "
                      "them: a bias. sharp: the normal at the very point: noise instead, which "
                      "samples_per_pixel_edge lowers."),
                field("colors", &Params::colors,
                      "filtered: the mean color of a sample's footprint, by mip levels. sharp: the color at "
                      "the very point: patterns where texels are smaller than samples are apart, as "
                      "published in Magalhães 2020 (section 5.1.4), for comparison.")};
        }
    };

    explicit GBufferPass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void trace(PassContext& context);
    void rasterize(PassContext& context);
    void beginMotion(PassContext& context);
    void endMotion(PassContext& context);
    bool hasMotion(const PortAccess& access) const { return access.get(motion_).isRead; }

    Params params_;
    Port<GBuffer> gbuffer_;
    Port<SurfaceMotion> motion_;
    Program aim_, shade_;            ///< Of rays.
    Buffer rays_, hits_;             ///< Of rays.
    Program background_, surfaces_;  ///< Of raster.
    Image depth_;                    ///< Of raster.
    // Of motion, where it is read
    Program findMotion_;
    Sampler sampler_;
    LargeBuffer previousPositions_;  ///< Of vertices, m.
    Buffer instanceStarts_;          ///< First triangle of each mesh instance.
    struct Before {
        View view;
        uint64_t sceneVersion;  ///< Of previousPositions_.
    };
    std::optional<Before> before_;  ///< Of the last frame; none before the first one.
};

}  // namespace voxray

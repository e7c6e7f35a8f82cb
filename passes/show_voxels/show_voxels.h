#pragma once

#include <array>
#include <optional>
#include <utility>

#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/view/frame_image.h"
#include "passes/common/voxel_march/voxel_march.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/show_voxels/lit_faces.h"

namespace voxray {

enum class ShownValue { Albedo, Irradiance, Opacity, Normal, LitFaces, Radiance, RadianceOpacity };

template <>
struct EnumNames<ShownValue> {
    static constexpr std::array names{std::pair{ShownValue::Albedo, "albedo"},
                                      std::pair{ShownValue::Irradiance, "irradiance"},
                                      std::pair{ShownValue::Opacity, "opacity"},
                                      std::pair{ShownValue::Normal, "normal"},
                                      std::pair{ShownValue::LitFaces, "lit_faces"},
                                      std::pair{ShownValue::Radiance, "radiance"},
                                      std::pair{ShownValue::RadianceOpacity, "radiance_opacity"}};
};

/// The voxels themselves, as cubes, seen by the camera: for looking at what other passes read.
class ShowVoxels final : public Pass {
 public:
    static constexpr const char* kName = "show_voxels";
    static constexpr const char* kHelp =
        "An image of voxels as cubes, each in the color of what it holds: the first voxel on the ray through "
        "each pixel's center, without antialiasing. Surface voxels, or prefiltered ones of any level. For "
        "looking at, not for scores. Exact, no noise of its own.";
    struct Params {
        ShownValue show = ShownValue::Albedo;
        uint32_t redAt = 225;
        uint32_t level = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("show", &Params::show,
                      "Of surface voxels. albedo: diffuse reflectance. irradiance: what arrives at the face "
                      "that is seen, as the radiance of a white surface there (over pi); magenta where the "
                      "injection did not look. opacity: 0 to 1. normal: each component from -1 to 1 as 0 to "
                      "1. lit_faces: how many lit faces of voxels the face sees by its list "
                      "(cluster_visibility), none as green, red_at as red; of a part of a cluster all count "
                      "(Cosin and Patow 2022, figure 13); magenta where no surfel looks that way. Of "
                      "prefiltered voxels, which cones read. radiance: what their surfaces send through the "
                      "face that is seen. radiance_opacity: the part of a beam that they hide there."),
                field("red_at", &Params::redAt, "So many lit faces, and more, are red.", 1u, 1u << 24)
                    .onlyWith(oneOf(&Params::show, {ShownValue::LitFaces})),
                field("level", &Params::level,
                      "Level of the prefiltered voxels: each is twice as wide as those of the level before.",
                      0u, 15u)
                    .onlyWith(oneOf(&Params::show, {ShownValue::Radiance, ShownValue::RadianceOpacity}))};
        }
    };

    explicit ShowVoxels(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    bool showsLight() const { return params_.show == ShownValue::Irradiance; }
    bool showsLitFaces() const { return params_.show == ShownValue::LitFaces; }
    bool showsLevel() const {
        return params_.show == ShownValue::Radiance || params_.show == ShownValue::RadianceOpacity;
    }
    /// Brings up to date what is shown of faces, and binds it.
    Binding faces(PassContext& context);
    void recordLevel(PassContext& context);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<const VoxelPatches> patches_;
    Port<const ClusterVisibility> visibility_;
    Port<const ClusterLight> clusterLight_;
    Port<const RadianceVoxels> radiance_;
    Port<FrameImage> final_;
    VoxelMarch march_{VoxelWalk::Bricks};
    FaceIrradiance faces_;
    LitFaces litFaces_;
    std::optional<std::pair<uint64_t, uint64_t>> facesVersion_;  ///< Of the voxels or lists, and of light.
    Program program_;
};

}  // namespace voxray

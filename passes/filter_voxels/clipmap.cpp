#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "base/error.h"
#include "passes/common/dispatch.h"
#include "passes/filter_voxels/clipmap_windows.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

constexpr uint32_t kValueBytes = 8;  // shaders/radiance_texel.glsl

/// The buffer `radianceVoxels` of shaders/radiance_clipmap.glsl.
struct Header {
    gpu::RadianceGrid grid;
    uint64_t values;
    uint32_t side;
    uint32_t firstWhole;
    std::array<gpu::ClipmapWindow, RADIANCE_CLIPMAP_LEVELS> windows;
};
static_assert(sizeof(gpu::RadianceGrid) % 8 == 0);

struct FillPush {
    gpu::VoxelGrid grid;
    float emission;
    VoxelBox box;
    uint32_t level;
    uint32_t source;
};

/// Windows follow the camera: what scrolls in is filled, the rest stays. Docs: docs/clipmap.md.
class ClipmapStorage final : public RadianceStorage {
 public:
    ClipmapStorage(uint32_t side, bool eachFrame) : side_(side), eachFrame_(eachFrame) {}

    void plan(PassPlan& plan, const SurfaceVoxels&, RadianceVoxels& radiance) override {
        if (!std::has_single_bit(side_))
            throw Error("filter_voxels: clipmap_resolution is {}; it has to be a power of two, such as {}",
                        side_, std::bit_floor(side_));
        radiance.grid.unit = 1;  // Values have an exponent of their own.
        windows_ = ClipmapWindows(radiance.grid, side_);
        const uint64_t values = windows_.voxels() * radiance.grid.directions;
        if (values > UINT32_MAX)
            throw Error("filter_voxels: {} values can't be numbered in 32 bits; lower clipmap_resolution",
                        values);
        plan.reserve("radiance clipmap", values * kValueBytes + sizeof(Header));
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        radiance.storage.clear();
        radiance.storage.emplace_back(setup.device, "radiance clipmap",
                                      windows_.voxels() * radiance.grid.directions * kValueBytes);
        radiance.header = Buffer(setup.device, "radiance clipmap's header", sizeof(Header));
        fill_ = makeComputeProgram(
            setup.device,
            setup.compiler.compile("passes/filter_voxels/clipmap_fill.comp", radiance.defines()));
        header_.reset();
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        // Move the windows.
        const std::pair version{voxels.version, light.version};
        const bool keep = header_ && !eachFrame_ && version == version_;
        Header header{radiance.grid, radiance.storage[0].address(), side_, windows_.firstWhole(), {}};
        for (uint32_t level = 0; level < radiance.grid.levels; ++level)
            header.windows[level] = windows_.window(level, context.frame.camera.position);
        context.stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));

        // Fill what is new in them; where surfaces or their light are, everything.
        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
        for (const Binding& binding : radiance.bindings()) bindings.push_back(binding);
        for (uint32_t level = 0; level < radiance.grid.levels; ++level) {
            const gpu::ClipmapWindow& window = header.windows[level];
            const std::vector<VoxelBox> boxes = keep ? scrolledIn(header_->windows[level], window)
                                                     : std::vector{VoxelBox{window.first, window.size}};
            // A level is made of the one below where that is held whole, else of the surfaces.
            const uint32_t source = level > header.firstWhole ? level - 1 : 0;
            for (const VoxelBox& box : boxes) {
                context.stream.dispatch(fill_, bindings, FillPush{voxels.grid, emission, box, level, source},
                                        linearGroups(box.count()));
                context.voxelSteps += box.count();
            }
        }
        header_ = header;
        version_ = version;
    }

 private:
    uint32_t side_;
    bool eachFrame_;
    ClipmapWindows windows_;
    Program fill_;
    std::optional<Header> header_;             ///< As it was in the last run.
    std::pair<uint64_t, uint64_t> version_{};  ///< Of the voxels and their light, likewise.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeClipmapStorage(uint32_t side, bool eachFrame) {
    return std::make_unique<ClipmapStorage>(side, eachFrame);
}

}  // namespace voxray

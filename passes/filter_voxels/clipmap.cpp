#include <utility>

#include "passes/common/clipmap/radiance_clipmap.h"
#include "passes/common/compute/dispatch.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

struct FillPush {
    gpu::VoxelGrid grid;
    float emission;
    glm::ivec3 boxFirst;
    glm::uvec3 boxSize;
    uint32_t level;
    uint32_t source;
};

/// Windows follow the camera: what scrolls in is filled, the rest stays, in a buffer or in a 3D texture.
/// Docs: docs/clipmap.md.
class ClipmapStorage final : public RadianceStorage {
 public:
    explicit ClipmapStorage(const ClipmapParams& params) : params_(params) {}
    bool followsCamera() const override { return true; }

    void plan(PassPlan& plan, const SurfaceVoxels&, RadianceVoxels& radiance) override {
        radiance.grid.levels = clipmapLevels(radiance.grid.resolution, params_, "filter_voxels");
        clipmap_ = RadianceClipmap(radiance.grid, params_.clipmapResolution);
        clipmap_.plan(plan, "filter_voxels", radiance);
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        fill_ = makeComputeProgram(
            setup.device,
            setup.compiler.compile("passes/filter_voxels/clipmap_fill.comp", radiance.defines()));
        clipmap_.prepare(setup, radiance);
        windows_.clear();
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        // Move the windows.
        const std::pair version{voxels.version, light.version};
        const bool keep = !windows_.empty() && version == version_;
        const std::vector<gpu::ClipmapWindow> windows = clipmap_.follow(context, radiance);

        // Fill what is new in them; where surfaces or their light are, everything.
        uint64_t updated = 0;
        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
        for (const Binding& binding : radiance.fillBindings()) bindings.push_back(binding);
        for (uint32_t level = 0; level < radiance.grid.levels; ++level) {
            const gpu::ClipmapWindow& window = windows[level];
            const std::vector<VoxelBox> boxes =
                keep ? scrolledIn(windows_[level], window) : std::vector{VoxelBox{window.first, window.size}};
            // A level is made of the one below where that is held whole, else of the surfaces.
            const uint32_t source = level > clipmap_.windows().firstWhole() ? level - 1 : 0;
            for (const VoxelBox& box : boxes) {
                context.stream.dispatch(fill_, bindings,
                                        FillPush{voxels.grid, emission, box.first, box.size, level, source},
                                        linearGroups(box.count()));
                updated += box.count();
            }
        }
        context.report(kUpdatedVoxels, double(updated));
        windows_ = windows;
        version_ = version;
    }

 private:
    ClipmapParams params_;
    RadianceClipmap clipmap_;
    Program fill_;
    std::vector<gpu::ClipmapWindow> windows_;  ///< As they were in the last run.
    std::pair<uint64_t, uint64_t> version_{};  ///< Of the voxels and their light, likewise.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeClipmapStorage(const ClipmapParams& params) {
    return std::make_unique<ClipmapStorage>(params);
}

}  // namespace voxray

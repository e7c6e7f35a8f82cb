#include "passes/cones/clipmap/radiance_clipmap.h"
#include "passes/cones/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

/// Windows that follow the camera, in a buffer or in a 3D texture: each frame fills what scrolled in. Docs:
/// docs/clipmap.md.
class ClipmapStorage final : public RadianceStorage {
 public:
    ClipmapStorage(ProgramOwner& owner, const ClipmapParams& params)
        : params_(params), fill_(owner, "clipmap_fill.comp") {}
    bool followsCamera() const override { return true; }

    void plan(PassPlan& plan, const SurfaceVoxels&, RadianceVoxels& radiance) override {
        radiance.grid.levels = clipmapLevels(radiance.grid.resolution, params_, "filter_voxels");
        clipmap_ = RadianceClipmap(radiance.grid, params_.clipmapResolution);
        clipmap_.plan(plan, "filter_voxels", radiance);
        fill_.define(radiance.defines());
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override { clipmap_.prepare(setup, radiance); }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light, RadianceVoxels& radiance,
             float emission) override {
        const bool isUnchanged = !context.changed(voxels) && !light.isNew;
        const std::vector<gpu::ClipmapWindow> windows = clipmap_.moveWindows(context, radiance);

        // Fill what scrolled in; everything if surfaces or their light changed
        uint64_t updated = 0;
        for (uint32_t level = 0; level < radiance.grid.levels; ++level) {
            const gpu::ClipmapWindow& window = windows[level];
            const std::vector<VoxelBox> boxes =
                isUnchanged ? scrolledIn(windows_[level], window) : std::vector{VoxelBox{window.first, window.size}};
            // A level is filtered from the next finer one if that is a whole grid, else from the surfaces
            const uint32_t source = level > clipmap_.windows().firstWhole() ? level - 1 : 0;
            for (const VoxelBox& box : boxes) {
                context.dispatch(fill_, box.count(),
                                 {voxels,
                                  light,
                                  radiance.fillBindings(),
                                  {"emission", emission},
                                  {"boxFirst", box.first},
                                  {"boxSize", box.size},
                                  {"level", level},
                                  {"source", source}});
                updated += box.count();
            }
        }
        context.report(kUpdatedVoxels, double(updated));
        windows_ = windows;
    }

 private:
    ClipmapParams params_;
    RadianceClipmap clipmap_;
    Kernel fill_;
    std::vector<gpu::ClipmapWindow> windows_;  ///< Of the last run.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeClipmapStorage(ProgramOwner& owner, const ClipmapParams& params) {
    return std::make_unique<ClipmapStorage>(owner, params);
}

}  // namespace voxray

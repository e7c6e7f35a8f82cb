#include "passes/cones/clipmap/radiance_clipmap.h"
#include "passes/cones/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

/// Windows follow the camera: what scrolls in is filled, the rest stays, in a buffer or in a 3D texture.
/// Docs: docs/clipmap.md.
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

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        // Move the windows.
        const bool keep = !context.changed(voxels) && !light.isNew;
        const std::vector<gpu::ClipmapWindow> windows = clipmap_.follow(context, radiance);

        // Fill what is new in them; where surfaces or their light are, everything.
        uint64_t updated = 0;
        for (uint32_t level = 0; level < radiance.grid.levels; ++level) {
            const gpu::ClipmapWindow& window = windows[level];
            const std::vector<VoxelBox> boxes =
                keep ? scrolledIn(windows_[level], window) : std::vector{VoxelBox{window.first, window.size}};
            // A level is made of the one below where that is held whole, else of the surfaces.
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
    std::vector<gpu::ClipmapWindow> windows_;  ///< As they were in the last run.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeClipmapStorage(ProgramOwner& owner, const ClipmapParams& params) {
    return std::make_unique<ClipmapStorage>(owner, params);
}

}  // namespace voxray

#include <algorithm>

#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/gather_surfels/undecided.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Surfaces in pixels whose kind is told at a time, unless a row has more: scratch memory does not grow with
/// the image.
static constexpr uint32_t kBandSurfaces = 1u << 19;

/// Indirect light per pixel from the surfels around it: albedo / pi times the mean of their irradiance,
/// weighted by how far each speaks for the pixel's surface. Voxels only tell which surfels are near. Source:
/// Ward, Rubinstein and Clear 1988 (irradiance of points on surfaces, interpolated); docs/surfels.md.
class GatherSurfels final : public Pass {
 public:
    static constexpr const char* kName = "gather_surfels";
    static constexpr const char* kHelp =
        "Reads indirect light at each pixel from the surfels around it. "
        "Takes the mean irradiance of the surfels in the eight voxels around the pixel's surface, "
        "those of the same plane before others. Tells two surfaces in one voxel apart. "
        "Biased by: the distance of surfels. Noisy by: points_per_voxel, rays_per_surfel. "
        "Lambert surfaces only. Source: Ward, Rubinstein and Clear 1988.";
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels, by which surfels are found"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light of voxels, where no surfel is near"};
    In<SurfelsByVoxel> surfels_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    In<SurfelIrradiance> light_{*this, "surfel_irradiance", "light that arrives at surfels"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    Kernel gather_{*this, "gather.comp"};
    Kernel resolve_{*this, "resolve.comp"};
    bool probed_ = false;  ///< Whether covered surfaces have surfels of their own.
    uint32_t bandRows_ = 1;
    Buffer count_, first_;                 ///< Scratch: of undecided surfaces, in all and by pixel of a band.
    Buffer undecided_, probes_, covered_;  ///< Scratch, of each undecided surface.
};

void GatherSurfels::plan(PassPlan& plan) {
    plan[indirect_].lightBounces = plan[irradiance_].lightBounces;
    probed_ = plan[surfels_].hasOccludedSurfels;
    const uint32_t samples = plan[gbuffer_].samples, perPixel = samples * samples, width = plan.frame.width;
    bandRows_ = plan.frame.height;
    if (probed_) {
        bandRows_ = std::clamp(kBandSurfaces / (width * perPixel), 1u, plan.frame.height);
        const uint64_t surfaces = uint64_t(width) * bandRows_ * perPixel;
        plan.scratchBuffer(count_, "number of undecided surfaces", sizeof(uint32_t));
        plan.scratchBuffer(first_, "undecided surfaces of pixels", width * bandRows_ * sizeof(uint32_t));
        plan.scratchBuffer(undecided_, "undecided surfaces", surfaces * sizeof(gpu::Undecided));
        plan.scratchBuffer(probes_, "rays that tell covered surfaces", surfaces * sizeof(Ray));
        plan.scratchBuffer(covered_, "covered surfaces", surfaces * sizeof(uint32_t));
    }
    plan.frameImage(indirect_);
    for (Kernel* kernel : {&gather_, &resolve_})
        kernel->define({{"SAMPLES", std::to_string(samples)}, {"PROBED", probed_ ? "1" : "0"}});
    resolve_.compileIf(probed_);
}

void GatherSurfels::record(PassContext& context) {
    const VoxelIrradiance& irradiance = context[irradiance_];
    const Image& result = context[indirect_].image;
    for (uint32_t row = 0; row < context.frame.height; row += bandRows_) {
        const glm::uvec2 extent(context.frame.width, std::min(bandRows_, context.frame.height - row));
        if (probed_) context.stream.fill(count_, 0);
        context.dispatch(gather_, extent,
                         {context.scene,
                          context[gbuffer_],
                          context[voxels_],
                          {"lists", context[surfels_].lists},
                          {"VoxelFluxRef", irradiance.indirect.ref()},
                          {"voxelArea", irradiance.area},
                          {"LitRef", context[light_].lit.ref()},
                          ifUsed({"count", count_}),
                          ifUsed({"surfaces", undecided_}),
                          ifUsed({"probes", probes_}),
                          ifUsed({"first", first_}),
                          {"result", result},
                          {"extent", extent},
                          {"firstRow", row},
                          {"noise", context[light_].relativeVariance}});
        if (!probed_) continue;

        // Which of the surfaces that surfels of both kinds are near lie in gaps narrower than a voxel.
        const uint32_t undecided = context.stream.readAs<uint32_t>(count_, 1)[0];
        if (undecided == 0) continue;
        context.tracer.occluded(context.stream, probes_, covered_, undecided, Coherence::Coherent);
        context.dispatch(resolve_, extent,
                         {{"surfaces", undecided_},
                          {"covered", covered_},
                          {"first", first_},
                          {"result", result},
                          {"extent", extent},
                          {"firstRow", row}});
    }
}

VOXRAY_REGISTER_PASS(GatherSurfels);

}  // namespace voxray

#include <algorithm>

#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/gather_surfels/ambiguous_surface.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

static constexpr uint64_t kSidesBytes = 4 * sizeof(uint32_t);  ///< Of a voxel.

/// Ambiguous surfaces of a band of rows, unless one row may have more: scratch memory does not grow with the
/// image.
static constexpr uint32_t kMaxBandSurfaces = 1u << 19;

/// Radiance per pixel from the surfels around it: albedo / pi times the weighted mean of their irradiance.
/// Voxels only serve to find surfels. Source: Ward, Rubinstein and Clear 1988 (irradiance of points on
/// surfaces, interpolated); docs/surfels.md.
class GatherSurfels final : public Pass {
 public:
    static constexpr const char* kName = "gather_surfels";
    static constexpr const char* kHelp =
        "Interpolates indirect light at each pixel from the surfels around it. "
        "Takes the mean irradiance of the surfels in the eight voxels around the pixel's surface, "
        "weighted by position and normal, so that two surfaces in a voxel don't mix. "
        "Biased by: the distance of surfels. Noisy by: points_per_voxel, rays_per_surfel. Lambert surfaces only. "
        "Source: Ward, Rubinstein and Clear 1988.";
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Finds which surfels of each voxel are on the same side of a surface.
    void findSides(PassContext& context);

    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels, by which surfels are found"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light of voxels, read where no surfel is near"};
    In<SurfelsByVoxel> surfels_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    In<SurfelIrradiance> light_{*this, "surfel_irradiance", "light that arrives at surfels"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    Kernel findSides_{*this, "find_sides.comp"};
    Kernel gather_{*this, "gather.comp"};
    Kernel resolve_{*this, "resolve.comp"};
    bool testsOcclusion_ = false;  ///< Whether there are occluded surfels.
    uint32_t bandRows_ = 1;
    LargeBuffer sides_;     ///< By voxel (voxel_sides.glsl).
    Buffer count_, first_;  ///< Scratch: number of ambiguous surfaces, and the first of each pixel.
    Buffer ambiguous_, occlusionRays_, occluded_;  ///< Scratch, by ambiguous surface.
};

void GatherSurfels::plan(PassPlan& plan) {
    plan[indirect_].lightBounces = plan[irradiance_].lightBounces;
    plan.estimate(plan[voxels_].estimatedCount * kSidesBytes);
    testsOcclusion_ = plan[surfels_].hasOccludedSurfels;
    const uint32_t samples = plan[gbuffer_].samples, perPixel = samples * samples, width = plan.frame.width;
    bandRows_ = plan.frame.height;
    if (testsOcclusion_) {
        bandRows_ = std::clamp(kMaxBandSurfaces / (width * perPixel), 1u, plan.frame.height);
        const uint64_t surfaces = uint64_t(width) * bandRows_ * perPixel;
        plan.scratchBuffer(count_, "number of ambiguous surfaces", sizeof(uint32_t));
        plan.scratchBuffer(first_, "ambiguous surfaces of pixels", width * bandRows_ * sizeof(uint32_t));
        plan.scratchBuffer(ambiguous_, "ambiguous surfaces", surfaces * sizeof(gpu::AmbiguousSurface));
        plan.scratchBuffer(occlusionRays_, "occlusion rays", surfaces * sizeof(Ray));
        plan.scratchBuffer(occluded_, "occluded surfaces", surfaces * sizeof(uint32_t));
    }
    plan.frameImage(indirect_);
    for (Kernel* kernel : {&gather_, &resolve_})
        kernel->define({{"SAMPLES", std::to_string(samples)}, {"TESTS_OCCLUSION", testsOcclusion_ ? "1" : "0"}});
    resolve_.compileIf(testsOcclusion_);
}

void GatherSurfels::findSides(PassContext& context) {
    const uint32_t voxels = context[voxels_].voxelCount;
    ensureSize(sides_, context.device, "sides of surfels", voxels * kSidesBytes);
    context.dispatch(findSides_, voxels,
                     {{"surfelRanges", context[surfels_].ranges},
                      {"LitRef", context[light_].lit.ref()},
                      {"SidesRef", sides_.ref()},
                      {"voxels", voxels}});
}

void GatherSurfels::record(PassContext& context) {
    const VoxelIrradiance& irradiance = context[irradiance_];
    const Image& result = context[indirect_].image;
    if (context.changed(surfels_)) findSides(context);
    for (uint32_t row = 0; row < context.frame.height; row += bandRows_) {
        const glm::uvec2 extent(context.frame.width, std::min(bandRows_, context.frame.height - row));
        if (testsOcclusion_) context.stream.fill(count_, 0);
        context.dispatch(gather_, extent,
                         {context.scene,
                          context[gbuffer_],
                          context[voxels_],
                          {"SidesRef", sides_.ref()},
                          {"VoxelFluxRef", irradiance.indirect.ref()},
                          {"voxelArea", irradiance.area},
                          {"LitRef", context[light_].lit.ref()},
                          ifUsed({"count", count_}),
                          ifUsed({"surfaces", ambiguous_}),
                          ifUsed({"occlusionRays", occlusionRays_}),
                          ifUsed({"first", first_}),
                          {"result", result},
                          {"extent", extent},
                          {"firstRow", row},
                          {"noise", context[light_].relativeVariance}});
        if (!testsOcclusion_) continue;

        // Resolve surfaces with surfels of both kinds around them
        const uint32_t ambiguous = context.stream.readAs<uint32_t>(count_, 1)[0];
        if (ambiguous == 0) continue;
        context.tracer.occluded(context.stream, occlusionRays_, occluded_, ambiguous, Coherence::Coherent);
        context.dispatch(resolve_, extent,
                         {{"surfaces", ambiguous_},
                          {"occluded", occluded_},
                          {"first", first_},
                          {"result", result},
                          {"extent", extent},
                          {"firstRow", row}});
    }
}

VOXRAY_REGISTER_PASS(GatherSurfels);

}  // namespace voxray

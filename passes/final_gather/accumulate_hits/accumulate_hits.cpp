#include <algorithm>
#include <optional>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/cache/hit_faces/hit_face_light.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gather_light.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/final_gather/accumulate_hits/kept_hit_types.h"

namespace voxray {
namespace {

bool seesTheSame(const Camera& a, const Camera& b) {
    return a.position == b.position && a.forward == b.forward && a.up == b.up &&
           a.verticalFovRadians == b.verticalFovRadians;
}

}  // namespace

/// A history of hits in place of light: gather rays of earlier frames read the light that their faces have now. Source:
/// Sbert, Szécsi and Szirmay-Kalos 2004 (paths that are kept get other light); docs/hit-faces.md.
class AccumulateHits final : public Pass {
 public:
    static constexpr const char* kName = "accumulate_hits";
    static constexpr const char* kFilterLabel = "hits accumulated";
    static constexpr const char* kHelp =
        "Averages gather rays over frames without lag: kept hits read the light of this frame. "
        "Follows gather_rays with `source: hit_faces` and a light_hit_faces with an update_budget. Where a ray brought "
        "other light than that of its face, as paths from near hits do, the difference is averaged over frames. "
        "Begins anew where the camera or surfaces move. "
        "Biased by: what gather_rays is biased by; lag of these differences. Source: Sbert et al. 2004.";
    struct Params {
        uint32_t history = 16;
        static constexpr auto schema() {
            return std::tuple{field("history", &Params::history,
                                    "Frames in the mean at most, this one included; 20 bytes a gather ray each.", 1u,
                                    64u)};
        }
    };

    explicit AccumulateHits(const Params& params) : params_(params) {}
    uint32_t warmupFrames() const override { return params_.history - 1; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Forgets the hits of other views and surfaces, and counts this frame's.
    void count(PassContext& context);

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    In<GatherLight> rayLight_{*this, "gather_light", "what each gather ray brings"};
    In<VoxelLevels> voxels_{*this, "voxels", "surface voxels whose faces are lit"};
    In<HitFaceLight> faces_{*this, "hit_face_light", "light of the faces that rays hit"};
    In<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance of this frame"};
    Out<NoisyIrradiance> accumulated_{*this, "noisy_irradiance", "mean irradiance over frames"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of this irradiance"};
    Kernel accumulate_{*this, "accumulate_hits.comp"};
    IrradianceResolve resolve_{*this};
    std::vector<Buffer> kept_;  ///< By batch of gather rays: KeptHit.
    // Of the frame before
    uint32_t frames_ = 0, slot_ = 0;
    std::optional<Camera> camera_;
    uint64_t generation_ = 0;
};

void AccumulateHits::plan(PassPlan& plan) {
    const GatherHits& hits = plan[hits_];
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    if (hits.layout.raysPerBlock < texelsPerBlock)
        throw Error("{}: each texel needs a ray in each frame; raise 'rays_per_block' of trace_gather_rays to {}",
                    kName, texelsPerBlock);
    if (!plan[faces_].keepsNumbers)
        throw Error("{}: light_hit_faces makes its faces anew in each frame; give it an 'update_budget'", kName);
    kept_ = std::vector<Buffer>(hits.batches.size());
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint64_t rays = uint64_t(hits.batchBlocks(b)) * hits.layout.raysPerBlock;
        plan.buffer(kept_[b], "kept hits", rays * params_.history * sizeof(gpu::KeptHit));
    }

    const NoisyIrradiance& noisy = plan[noisy_];
    plan[accumulated_].planAccumulated(plan, noisy, plan[gbuffer_].samples);
    plan[indirect_].lightBounces = noisy.lightBounces;
    if (plan[indirect_].isRead) plan.frameImage(indirect_);
}

void AccumulateHits::count(PassContext& context) {
    const uint64_t generation = context[faces_].generation;
    if (!camera_ || !seesTheSame(*camera_, context.frame.camera) || generation_ != generation) frames_ = slot_ = 0;
    camera_ = context.frame.camera;
    generation_ = generation;
    slot_ = frames_ == 0 ? 0 : (slot_ + 1) % params_.history;
    frames_ = std::min(frames_ + 1, params_.history);
}

void AccumulateHits::record(PassContext& context) {
    count(context);
    const GatherHits& hits = context[hits_];
    const NoisyIrradiance& result = context[accumulated_];
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    for (uint32_t b = 0; b < hits.batches.size(); ++b)
        context.dispatch(accumulate_, uint64_t(hits.batchBlocks(b)) * texelsPerBlock,
                         {context.scene,
                          context[voxels_],
                          context[faces_],
                          {"position", context[gbuffer_].position},
                          {"hits", hits.batches[b]},
                          {"light", context[rayLight_].light[b]},
                          {"kept", kept_[b]},
                          {"result", result.irradiance},
                          {"layout", hits.layout},
                          {"firstBlock", b * hits.blocksPerBatch},
                          {"batchBlocks", hits.batchBlocks(b)},
                          {"slot", slot_},
                          {"frames", frames_}});

    result.copyVariance(context.stream, context[noisy_]);
    if (const FrameImage& indirect = context[indirect_]; indirect.isRead)
        resolve_.record(context, context[gbuffer_], result.irradiance, indirect.image);
    context.report("frames of hits", frames_);
}

VOXRAY_REGISTER_PASS(AccumulateHits);

}  // namespace voxray

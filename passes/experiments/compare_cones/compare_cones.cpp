#include <array>
#include <string>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/cones/radiance/cone_sets.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/experiments/compare_cones/cone_record.h"

namespace voxray {

/// Where cones' light differs from that of exact rays along their axes, over the same voxels. Docs:
/// docs/cone-tracing.md.
class CompareCones final : public Pass {
 public:
    static constexpr const char* kName = "compare_cones";
    static constexpr const char* kHelp =
        "Compares cones with exact rays along their axes, through the same voxels. "
        "Reports, over the light along the rays, read in the finest voxels: light read in voxels as wide as the cone, "
        "and of each level; the cones' light, by where they take it along the ray and by level; and the opacity that "
        "they find before what the ray hits, and lack behind it. Without the noise and the filter of gather_cones.";
    struct Params {
        uint32_t cones = 16;
        uint32_t stride = 16;
        float width = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("cones", &Params::cones, "Cones from each texel, as of gather_cones.", coneSetSizes()),
                field("stride", &Params::stride, "Compares at every n-th texel of the G-buffer.", 1u, 64u),
                field("width", &Params::width,
                      "Of cones over that of gather_cones. 0: thin rays through the finest voxels.", 0.0f, 8.0f)};
        }
    };
    explicit CompareCones(const Params& params) : params_(params) {}

    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    using Record = std::array<double, RECORDED_NUMBERS>;
    /// Sums of the records of a batch of texels' cones.
    Record compare(PassContext& context, uint32_t firstTexel, uint32_t texels);
    void report(PassContext& context, const Record& sums) const;

    static constexpr uint32_t kBatchTexels = 4096;

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    Kernel generateRays_{*this, "passes/cones/radiance/generate_cone_rays.comp"};
    Kernel compare_{*this, "compare.comp"};
    glm::uvec2 extent_{};  ///< Columns and rows of the compared texels.
    Buffer cones_, rays_, hits_, records_;
};

void CompareCones::plan(PassPlan& plan) {
    const glm::uvec2 texels = gbufferExtent(plan.frame, plan[gbuffer_].samples);
    extent_ = {(texels.x + params_.stride - 1) / params_.stride, texels.y};
    const uint32_t cones = std::min(extent_.x * extent_.y, kBatchTexels) * params_.cones;
    plan.buffer(cones_, "cones", coneSet(params_.cones).size() * sizeof(gpu::Cone));
    plan.buffer(rays_, "rays of cones", cones * sizeof(Ray));
    plan.buffer(hits_, "hits of cones' rays", cones * sizeof(Hit));
    plan.buffer(records_, "records of cones", uint64_t(cones) * RECORDED_NUMBERS * sizeof(float));
    compare_.define(plan[radiance_].defines());
}

void CompareCones::prepare(PassSetup& setup) {
    std::vector<gpu::Cone> cones = coneSet(params_.cones);
    for (gpu::Cone& cone : cones) cone.width *= params_.width;
    setup.stream.upload(cones_, cones);
}

void CompareCones::record(PassContext& context) {
    Record sums{};
    const uint32_t texels = extent_.x * extent_.y;
    for (uint32_t first = 0; first < texels; first += kBatchTexels) {
        const Record part = compare(context, first, std::min(kBatchTexels, texels - first));
        for (size_t k = 0; k < sums.size(); ++k) sums[k] += part[k];
    }
    report(context, sums);
}

CompareCones::Record CompareCones::compare(PassContext& context, uint32_t firstTexel, uint32_t texels) {
    const uint32_t cones = texels * params_.cones;
    const Bindings batch{{"cones", cones_},
                         {"tracedExtent", extent_},
                         {"firstTexel", firstTexel},
                         {"batchCones", cones},
                         {"conesPerTexel", params_.cones},
                         {"stride", params_.stride},
                         {"range", 0.0f},
                         {"rayLength", 1e30f},
                         {"shift", glm::vec2(0)}};
    context.dispatch(generateRays_, cones, {context.scene, context[gbuffer_], {"rays", rays_}, batch.all()});
    context.tracer.closestHit(context.stream, rays_, hits_, cones);
    context.dispatch(compare_, cones,
                     {context.scene,
                      context[gbuffer_],
                      context[radiance_],
                      {"rays", rays_},
                      {"hits", hits_},
                      {"records", records_},
                      batch.all()});
    Record sums{};
    const auto records = context.stream.readAs<float>(records_, size_t(cones) * RECORDED_NUMBERS);
    for (size_t i = 0; i < records.size(); ++i) sums[i % RECORDED_NUMBERS] += records[i];
    return sums;
}

void CompareCones::report(PassContext& context, const Record& sums) const {
    const double rays = sums[RAY_NEAR] + sums[RAY_FAR];
    if (rays <= 0) throw Error("{}: the rays find no light in the voxels; inject light before filter_voxels", kName);
    const auto ofRays = [&](const std::string& name, double light) { context.report(name, light / rays); };
    const auto levels = [&](const std::string& name, int first) {
        for (int level = 0; level < RECORDED_LEVELS; ++level)
            ofRays(name + " level " + std::to_string(level), sums[size_t(first + level)]);
    };
    ofRays("rays, hits within 2 voxels", sums[RAY_NEAR]);
    ofRays("rays, read as wide as the cone", sums[RAY_CONE]);
    levels("rays, read in", RAY_LEVEL);

    double cones = 0;
    for (size_t part = CONE_START; part <= CONE_MISSED; ++part) cones += sums[part];
    ofRays("cones", cones);
    ofRays("cones, within 2 voxels of the start", sums[CONE_START]);
    ofRays("cones, before the ray's hit", sums[CONE_BEFORE]);
    ofRays("cones, at the ray's hit", sums[CONE_AT_HIT]);
    ofRays("cones, behind the ray's hit", sums[CONE_BEHIND]);
    ofRays("cones, where the ray hits nothing", sums[CONE_MISSED]);
    levels("cones, taken in", CONE_LEVEL);
    if (sums[WEIGHT_OF_HITS] <= 0) return;
    context.report("opacity before the ray's hit", sums[OPACITY_BEFORE] / sums[WEIGHT_OF_HITS]);
    context.report("opacity lacking behind it", sums[OPACITY_BEHIND] / sums[WEIGHT_OF_HITS]);
}

VOXRAY_REGISTER_PASS(CompareCones);

}  // namespace voxray

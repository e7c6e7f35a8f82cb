#include "passes/cones/gather_cones/cone_rays.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/random_seed.h"
#include "passes/path_trace/sobol.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchCones = 1u << 17;
constexpr uint32_t kMaxContinuations = 2;    // Of a path.
constexpr float kUnlimited = 1e30f;          // m
constexpr uint32_t kPathSeed = 0x52657369u;  // Beside other random numbers of the frame.
constexpr uint32_t kShiftSeed = 0x53686966u;

/// Sources but for emissive surfaces, which cones see themselves where voxels hold emission. @throws Error where shadow
/// rays can't tell them apart.
std::vector<LightSource> sourcesBesideEmitters(const SceneState& scene) {
    std::vector<LightSource> sources = lightSources(scene);
    const auto isTree = [](const LightSource& source) { return source.kind == LightSource::Tree; };
    const bool areJoined = std::ranges::any_of(shadowRaySources(sources, scene), isTree);
    const auto isEmitter = [](const LightSource& source) { return source.kind == LightSource::Emitters; };
    if (std::erase_if(sources, isEmitter) > 0 && areJoined)
        throw Error(
            "gather_cones: shadow rays from the near field sample more than {} point and spot lights together with "
            "emissive surfaces, which the radiance voxels hold already; set 'near_field_voxels' to 0, or 'emission' of "
            "filter_voxels to false",
            kExactLights);
    return sources;
}

}  // namespace

ConeRays::ConeRays(ProgramOwner& owner, bool hasResidual)
    : hitLight_(owner),
      generateRays_(owner, "passes/cones/radiance/generate_cone_rays.comp"),
      resolveRays_(owner, "resolve_cone_rays.comp"),
      reflect_(owner, "passes/surfels/reflect_at_hits.comp"),
      continuePaths_(owner, "continue_paths.comp"),
      beginPaths_(owner, "begin_paths.comp"),
      addResiduals_(owner, "add_residuals.comp"),
      splitResiduals_(owner, "split_residuals.comp"),
      blockMoments_(owner, "block_moments.comp"),
      sumCones_(owner, "sum_cones.comp") {
    if (hasResidual) streams_.emplace(owner);
}

void ConeRays::plan(PassPlan& plan, const RadianceVoxels& radiance, const Settings& settings,
                    NoisyIrradiance* residual) {
    settings_ = settings;
    const uint64_t cones = uint64_t(settings.tracedExtent.x) * settings.tracedExtent.y * settings.cones;
    const uint32_t batch = uint32_t(std::min<uint64_t>(cones, kBatchCones / settings.cones * settings.cones));
    plan.buffer(rays_, "rays of cones", batch * sizeof(Ray));
    plan.buffer(hits_, "hits of cones' rays", batch * sizeof(Hit));
    plan.buffer(light_, "light of cones", batch * 4 * sizeof(float));
    Defines defines = radiance.defines();
    if (settings.visibility == ConeVisibility::Rays) defines.emplace("VISIBLE_BY_RAYS", "1");
    if (hasNearField()) {
        planNearField(plan, radiance, batch);
        defines.emplace("NEAR_FIELD", "1");
        if (radiance.emission) defines.emplace("EMISSION", "1");
    }
    for (Kernel* kernel : {&resolveRays_, &continuePaths_}) kernel->define(defines);
    for (Kernel* kernel : {&reflect_, &continuePaths_}) kernel->compileIf(hasNearField());
    beginPaths_.compileIf(streams_.has_value());
    addResiduals_.compileIf(streams_ && !residual);
    for (Kernel* kernel : {&splitResiduals_, &blockMoments_}) kernel->compileIf(residual);
    if (!streams_) return;
    if (residual) planResidual(plan, *residual);
    streams_->plan(plan, {.bounces = settings.bounces, .light = PathLight::Indirect, .irradianceTexels = 1}, batch);
    plan.buffer(chosen_, "number of paths", sizeof(uint32_t));
}

void ConeRays::planResidual(PassPlan& plan, NoisyIrradiance& residual) {
    residual.lightBounces = settings_.bounces;
    residual.spacing = settings_.stride;
    residual.blockSize = 1;  // Then the least with a traced texel in most blocks.
    while (residual.blockSize * residual.blockSize < settings_.stride) ++residual.blockSize;
    const ImageDesc desc = NoisyIrradiance::desc(plan.frame, settings_.samples);
    plan.image(residual.irradiance, "residual of cones", desc);
    plan.buffer(residual.moments, "moments of the residual", residual.momentsBytes(desc.extent));
    const uint64_t traced = uint64_t(settings_.tracedExtent.x) * settings_.tracedExtent.y;
    plan.buffer(texelMoments_, "moments of texels' residual", traced * sizeof(gpu::RayMoments));
}

void ConeRays::planNearField(PassPlan& plan, const RadianceVoxels& radiance, uint32_t batchCones) {
    sources_ = radiance.emission ? sourcesBesideEmitters(*plan.frame.scene) : lightSources(*plan.frame.scene);
    hitLight_.plan(plan, batchCones);
    plan.buffer(count_, "number of near hits", sizeof(uint32_t));
    plan.buffer(direct_, "direct light at near hits", batchCones * 4 * sizeof(float));
    for (Buffer& surfels : surfels_) plan.buffer(surfels, "surfels at near hits", batchCones * sizeof(gpu::Surfel));
    for (Buffer& normals : continuations_)
        plan.buffer(normals, "normals at near hits", batchCones * 2 * sizeof(uint32_t));
}

void ConeRays::record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance, const Buffer& cones,
                      const Image& irradiance, const NoisyIrradiance* residual) {
    const uint32_t texels = settings_.tracedExtent.x * settings_.tracedExtent.y;
    const uint32_t maxBatchTexels = kBatchCones / settings_.cones;
    const float range = settings_.nearVoxels * radiance.grid.voxelSize;
    const bool endsInNearField = settings_.visibility == ConeVisibility::Voxels && !streams_;
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    if (streams_) {
        streams_->begin(context);
        context.stream.fill(chosen_, 0);
        if (residual) context.stream.clear(residual->irradiance, {});
    }
    for (uint32_t first = 0; first < texels; first += maxBatchTexels) {
        const uint32_t batchTexels = std::min(maxBatchTexels, texels - first);
        const uint32_t batchCones = batchTexels * settings_.cones;
        const Bindings batch{ifUsed({"cones", cones}),
                             {"tracedExtent", settings_.tracedExtent},
                             {"firstTexel", first},
                             {"batchCones", batchCones},
                             {"conesPerTexel", settings_.cones},
                             {"stride", settings_.stride},
                             {"range", range},
                             {"rayLength", endsInNearField ? range : kUnlimited},
                             {"shift", directionShift(seed)},
                             ifUsed({"probability", settings_.residual}),
                             ifUsed({"seed", seed})};

        // Rays along the cones, and what each cone sees
        context.dispatch(generateRays_, batchCones, {context.scene, gbuffer, {"rays", rays_}, batch.all()});
        context.tracer.closestHit(context.stream, rays_, hits_, batchCones);
        if (streams_) tracePaths(context, batch, first, batchTexels, seed);
        if (hasNearField()) context.stream.fill(count_, 0);
        context.dispatch(resolveRays_, batchCones,
                         {context.scene,
                          gbuffer,
                          radiance,
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light_},
                          ifUsed({"surfels", surfels_[0]}),
                          ifUsed({"continuations", continuations_[0]}),
                          ifUsed({"count", count_}),
                          batch.all()});
        if (hasNearField()) continuePaths(context, radiance, range, seed);
        if (residual)
            context.dispatch(splitResiduals_, batchTexels,
                             {gbuffer,
                              {"light", light_},
                              {"sums", streams_->sums()},
                              {"residual", residual->irradiance},
                              {"texelMoments", texelMoments_},
                              batch.all()});
        else if (streams_)
            context.dispatch(addResiduals_, batchCones, {{"light", light_}, {"sums", streams_->sums()}, batch.all()});
        context.dispatch(sumCones_, batchTexels, {{"light", light_}, {"irradiance", irradiance}, batch.all()});
    }
    if (residual) sumMoments(context, gbuffer, *residual);
    if (streams_) reportPaths(context);
}

void ConeRays::sumMoments(PassContext& context, const GBuffer& gbuffer, const NoisyIrradiance& residual) {
    const glm::uvec2 texels = gbufferExtent(context.frame, gbuffer.samples), blocks = residual.blocks(texels);
    context.dispatch(blockMoments_, blocks,
                     {{"texelMoments", texelMoments_},
                      {"moments", residual.moments},
                      {"texels", texels},
                      {"blocks", blocks},
                      {"blockSize", residual.blockSize},
                      {"stride", settings_.stride},
                      {"tracedColumns", settings_.tracedExtent.x}});
}

void ConeRays::reportPaths(PassContext& context) {
    // The rays to the paths' first hits are the cones'
    const uint32_t paths = context.stream.readAs<uint32_t>(chosen_, 1)[0];
    context.extraRays = streams_->rays(context) - paths;
    const double cones = double(settings_.tracedExtent.x) * settings_.tracedExtent.y * settings_.cones;
    context.report("paths, % of cones", 100.0 * paths / cones);
}

glm::vec2 ConeRays::directionShift(uint32_t seed) const {
    if (settings_.visibility == ConeVisibility::Voxels && !streams_) return glm::vec2(0);
    const auto unit = [&](uint32_t dimension) {
        return float(path_trace::hashOf(seed ^ kShiftSeed, dimension) >> 8) * 0x1p-24f;
    };
    return {unit(0), unit(1)};
}

void ConeRays::tracePaths(PassContext& context, const Bindings& batch, uint32_t firstTexel, uint32_t batchTexels,
                          uint32_t seed) {
    context.dispatch(beginPaths_, batchTexels * settings_.cones,
                     {{"rays", rays_}, {"hits", hits_}, streams_->open(context), {"chosen", chosen_}, batch.all()});
    // A texel's cones have one sequence of random numbers
    streams_->follow(context, {.firstPixel = firstTexel,
                               .pixels = batchTexels,
                               .firstSample = 0,
                               .samples = settings_.cones,
                               .width = settings_.tracedExtent.x * PATH_TILE,
                               .height = settings_.tracedExtent.y * PATH_TILE,
                               .halves = 1,
                               .pointsOfPixel = 0,
                               .seed = seed ^ kPathSeed});
}

void ConeRays::continuePaths(PassContext& context, const RadianceVoxels& radiance, float range, uint32_t batchSeed) {
    CommandStream& stream = context.stream;
    for (uint32_t bounce = 0; bounce < kMaxContinuations; ++bounce) {
        const uint32_t surfels = stream.readAs<uint32_t>(count_, 1)[0];
        if (surfels == 0) return;

        // Direct light at the near hits, and continuation rays.
        const uint32_t from = bounce % 2, to = 1 - from;
        const uint32_t seed = batchSeed + 0x51u + bounce * 0x9e3779b9u;
        hitLight_.measure(context, sources_, surfels_[from], surfels, 1, seed, direct_);
        context.dispatch(reflect_, surfels,
                         {context.scene,
                          {"surfels", surfels_[from]},
                          {"direct", direct_},
                          {"light", light_},
                          {"continuations", continuations_[from]},
                          {"rays", rays_},
                          {"count", surfels},
                          {"seed", seed + 0xa3u}});

        // Resolve these rays, the last ones by cones alone.
        context.tracer.closestHit(stream, rays_, hits_, surfels);
        stream.fill(count_, 0);
        context.dispatch(continuePaths_, surfels,
                         {context.scene,
                          radiance,
                          {"origins", surfels_[from]},
                          {"originNormals", continuations_[from]},
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light_},
                          {"surfels", surfels_[to]},
                          {"continuations", continuations_[to]},
                          {"count", count_},
                          {"rayCount", surfels},
                          {"range", bounce + 1 < kMaxContinuations ? range : 0.0f},
                          {"width", settings_.width},
                          {"seed", seed + 0xc7u}});
    }
}

}  // namespace voxray

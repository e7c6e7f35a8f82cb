#include "passes/gather_mirror/gather_mirror.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"
#include "passes/gather_mirror/grazing_table.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchSlots = 1u << 18;  // Bounds what a batch takes to 80 MiB, whatever the image.

struct BatchPush {
    gpu::MirrorBatch batch;
};

struct BeginPush {
    gpu::MirrorBatch batch;
    uint32_t count;
};

struct ShadePush {
    gpu::MirrorBatch batch;
    uint32_t count;
    uint32_t depth;
    uint32_t isLast;
};

/// As in shade.comp.
struct Counts {
    uint32_t next, surfels, triangles, cells, wide, missed;
};

/// Pixels whose rays are traced together.
uint32_t batchPixels(const Frame& frame, uint32_t samples, uint32_t rays) {
    return std::clamp(kBatchSlots / (samples * samples * rays), 1u, frame.width * frame.height);
}

uint32_t flagWords(uint64_t slots) {
    return uint32_t((slots + 31) / 32);
}

}  // namespace

void GatherMirror::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    if (isHybrid())
        leaves_ = builder.read<HybridLeaves>("hybrid_leaves", "what each leaf of the octree holds");
    if (widens())
        radiance_ = builder.read<RadianceVoxels>("radiance", "light that leaves surfaces, at all scales");
    lobes_ = builder.readOptional<SpecularLobes>("lobes", "specular light by cones, for what is rougher");
    otherDirect_ = builder.readOptional<FrameImage>("direct", "radiance reflected of direct light");
    otherIndirect_ = builder.readOptional<FrameImage>(
        "indirect", "radiance that diffuse albedos reflect of indirect light");
    direct_ = builder.write<FrameImage>("direct", "the same, and what mirrors show of lamps and environment");
    indirect_ = builder.write<FrameImage>("indirect", "the same, and what else mirrors show");
    ends_ = builder.write<MirrorEnds>("mirror_ends", "what a pixel's mirror rays ended on, to look at");
}

void GatherMirror::plan(PassPlan& plan) {
    if (plan.has(lobes_) && plan.get(lobes_).emission)
        throw Error(
            "gather_mirror: the cones of 'lobes' bring what surfaces emit, which rays and the direct pass "
            "bring "
            "too; set 'emission' of filter_voxels to false");
    if (widens() && plan.get(radiance_).emission)
        throw Error(
            "gather_mirror: wide rays would bring what surfaces emit, which other passes bring, too; set "
            "'emission' "
            "of filter_voxels to false");
    if (plan.has(lobes_)) plan.get(lobes_).isJoined = true;
    const uint32_t samples = plan.get(gbuffer_).samples;
    const uint64_t slots =
        uint64_t(batchPixels(plan.frame, samples, params_.rays)) * samples * samples * params_.rays;

    plan.buffer(grid_, "grid of voxels", sizeof(gpu::VoxelGrid));
    plan.buffer(grazing_, "what a dielectric layer takes", GRAZING_COSINES * sizeof(float));
    plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(plan.get(voxels_).voxelCount));
    plan.image(black_, "black", ImageDesc{});
    plan.image(plan.get(direct_).image, "direct", frameImageDesc(plan.frame));
    plan.image(plan.get(indirect_).image, "indirect", frameImageDesc(plan.frame));
    plan.image(plan.get(ends_).parts, "ends of mirror rays", frameImageDesc(plan.frame));
    // What voxels hold is reflected once more where rays end; an empty number counts as none.
    std::optional<uint32_t> bounces = oneMore(plan.get(irradiance_).lightBounces);
    if (plan.has(otherIndirect_)) bounces = std::max(bounces, plan.get(otherIndirect_).lightBounces);
    plan.get(indirect_).lightBounces = bounces;
    plan.get(indirect_).hasSpecularLobes = true;

    plan.buffer(counts_, "numbers of mirror rays", sizeof(Counts));
    plan.buffer(flags_, "flags of mirror rays", flagWords(slots) * sizeof(uint32_t));
    plan.buffer(slots_, "list of mirror rays", slots * sizeof(uint32_t));
    plan.buffer(light_, "light of mirror rays", slots * sizeof(gpu::MirrorLight));
    for (Buffer& paths : paths_) plan.buffer(paths, "paths of mirror rays", slots * sizeof(gpu::MirrorPath));
    for (Buffer& rays : rays_) plan.buffer(rays, "mirror rays", slots * sizeof(Ray));
    if (isHybrid()) {
        hybrid_.emplace(params_.walk == MirrorWalk::Hierarchical ? HybridWalk::Hierarchical
                                                                 : HybridWalk::VoxelByVoxel);
        hybrid_->plan(plan, plan.get(voxels_));
        for (Buffer& starts : starts_)
            plan.buffer(starts, "starts of mirror rays", slots * sizeof(gpu::RayStart));
    }
    plan.buffer(hits_, "hits of mirror rays", slots * sizeof(Hit));
    plan.buffer(surfels_, "surfels at hits", (shadowRays() ? slots : 1) * sizeof(gpu::Surfel));
    plan.reserveScratch("listing mirror rays", Compaction::scratchBytes(flagWords(slots)));
    if (!shadowRays()) return;
    sources_ = lightSources(*plan.frame.scene);
    hitLight_.plan(plan, uint32_t(slots));
    plan.buffer(hitDirect_, "direct light at hits", slots * 4 * sizeof(float));
}

void GatherMirror::prepare(PassSetup& setup) {
    const Defines defines = isHybrid() ? Defines{{"HYBRID", "1"}} : Defines{};
    const auto program = [&](const char* file, const SpecializationConstants& constants) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines), constants);
    };
    if (hybrid_) hybrid_->prepare(setup.device, setup.compiler);
    mark_ = program("passes/gather_mirror/mark.comp", {});
    begin_ = program("passes/gather_mirror/begin.comp", {});
    shade_ = program("passes/gather_mirror/shade.comp", {{"kShadowRays", shadowRays()}});
    if (widens())
        wide_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_mirror/wide.comp",
                                                                        setup.get(radiance_).defines()));
    resolve_ = program("passes/gather_mirror/resolve.comp", {{"kHasLobes", setup.has(lobes_)}});
    if (shadowRays()) {
        reflect_ = program("passes/gather_mirror/reflect.comp", {});
        hitLight_.prepare(setup);
    }
    compaction_.emplace(setup.device, setup.compiler);
    sampler_ = texelSampler(setup.device);
    faces_ = FaceIrradiance(setup.device, setup.compiler);
    facesVersion_.reset();
    setup.stream.upload(grazing_, grazingTable());
    setup.stream.clear(black_, {});
}

gpu::MirrorBatch GatherMirror::firstBatch(const Frame& frame, uint32_t samples, uint32_t frameIndex) const {
    const CameraRays rays = cameraRays(frame.camera, frame.width, frame.height);
    gpu::MirrorBatch batch{};
    batch.camera = frame.camera.position;
    batch.width = frame.width;
    batch.forward = rays.forward;
    batch.samples = samples;
    batch.rays = params_.rays;
    batch.maxRoughness = params_.maxRoughness;
    batch.blendRoughness = params_.blendRoughness;
    batch.texelArea = 4 * glm::length(rays.right) * glm::length(rays.up) /
                      float(uint64_t(frame.width) * frame.height * samples * samples);
    batch.seed = randomSeed(frame, frameIndex);
    return batch;
}

void GatherMirror::record(PassContext& context) {
    updateFaces(context);
    const Frame& frame = context.frame;
    const uint32_t samples = context.get(gbuffer_).samples, pixels = frame.width * frame.height;
    const uint32_t perBatch = batchPixels(frame, samples, params_.rays);
    gpu::MirrorBatch batch = firstBatch(frame, samples, context.frameIndex);
    triangleHits_ = cellHits_ = wideRays_ = misses_ = 0;
    if (hybrid_) {
        const SurfaceVoxels& voxels = context.get(voxels_);
        const float widest = widens() ? voxels.grid.voxelSize : std::numeric_limits<float>::infinity();
        hybrid_->begin(context.stream, context.scene, voxels, context.get(leaves_), widest);
    }
    for (uint32_t first = 0; first < pixels; first += perBatch) {
        batch.firstPixel = first;
        batch.pixels = std::min(perBatch, pixels - first);
        gather(context, batch);
        resolve(context, batch);
    }
    context.report("mirror rays that hit triangles", double(triangleHits_));
    context.report("mirror rays that missed", double(misses_));
    if (!hybrid_) return;
    context.report("mirror rays that hit cells of grids", double(cellHits_));
    if (widens()) context.report("mirror rays that went on as cones", double(wideRays_));
    context.voxelCounts.push_back(&hybrid_->counts());
}

void GatherMirror::updateFaces(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& light = context.get(irradiance_);
    const std::pair version{voxels.version, light.version};
    if (facesVersion_ == version) return;
    faces_.update(context.stream, voxels, light.area, light.indirect, shadowRays() ? nullptr : &light.direct);
    context.stream.upload(grid_, std::vector{voxels.grid});
    facesVersion_ = version;
}

void GatherMirror::gather(PassContext& context, const gpu::MirrorBatch& batch) {
    // List the slots that send a ray.
    const GBuffer& gbuffer = context.get(gbuffer_);
    CommandStream& stream = context.stream;
    const uint64_t slots = uint64_t(batch.pixels) * batch.samples * batch.samples * batch.rays;
    stream.fill(light_, 0);
    stream.fill(flags_, 0);
    stream.dispatch(mark_,
                    {{"position", gbuffer.position, sampler_},
                     {"specular", gbuffer.specular, sampler_},
                     {"fresnel", gbuffer.fresnel, sampler_},
                     {"flags", flags_}},
                    BatchPush{batch}, linearGroups(slots));
    uint32_t count = compaction_->run(stream, flags_, slots_, flagWords(slots));
    if (count == 0) return;

    // Their first rays, and those that mirrors send on.
    std::vector<Binding> beginning =
        context.scene.bindings({{"position", gbuffer.position, sampler_},
                                {"normal", gbuffer.normal, sampler_},
                                {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                {"specular", gbuffer.specular, sampler_},
                                {"fresnel", gbuffer.fresnel, sampler_},
                                {"slots", slots_},
                                {"paths", paths_[0]},
                                {"rays", rays_[0]}});
    if (hybrid_) beginning.emplace_back("starts", starts_[0]);
    stream.dispatch(begin_, beginning, BeginPush{batch, count}, linearGroups(count));
    for (uint32_t depth = 0; depth < params_.bounces && count > 0; ++depth) {
        trace(context, depth, count);
        count = end(context, batch, depth, count);
    }
}

void GatherMirror::trace(PassContext& context, uint32_t depth, uint32_t count) {
    const Buffer& rays = rays_[depth % 2];
    if (!hybrid_) {
        context.tracer.closestHit(context.stream, rays, hits_, count);
        return;
    }
    hybrid_->closestFrom(context.stream, rays, starts_[depth % 2], hits_, count);
    context.extraRays += count;
    if (!widens()) return;
    std::vector<Binding> bindings = context.get(radiance_).bindings();
    bindings.insert(bindings.end(), {{"paths", paths_[depth % 2]},
                                     {"rays", rays},
                                     {"starts", starts_[depth % 2]},
                                     {"hits", hits_},
                                     {"light", light_}});
    context.stream.dispatch(wide_, bindings, count, linearGroups(count));
}

uint32_t GatherMirror::end(PassContext& context, const gpu::MirrorBatch& batch, uint32_t depth,
                           uint32_t count) {
    CommandStream& stream = context.stream;
    stream.fill(counts_, 0);
    std::vector<Binding> bindings = context.scene.bindings({{"grazing", grazing_},
                                                            faces_.binding(),
                                                            {"grid", grid_},
                                                            {"paths", paths_[depth % 2]},
                                                            {"rays", rays_[depth % 2]},
                                                            {"hits", hits_},
                                                            {"nextPaths", paths_[(depth + 1) % 2]},
                                                            {"nextRays", rays_[(depth + 1) % 2]},
                                                            {"surfels", surfels_},
                                                            {"light", light_},
                                                            {"counts", counts_}});
    const SurfaceVoxels& voxels = context.get(voxels_);
    if (hybrid_) {
        for (const Binding& binding : context.get(leaves_).bindings()) bindings.push_back(binding);
        bindings.emplace_back("nextStarts", starts_[(depth + 1) % 2]);
    }
    const uint32_t isLast = depth + 1 == params_.bounces ? 1 : 0;
    stream.dispatch(shade_, voxels.bindings(bindings), ShadePush{batch, count, depth, isLast},
                    linearGroups(count));
    const Counts counts = stream.readAs<Counts>(counts_, 1)[0];
    triangleHits_ += counts.triangles;
    cellHits_ += counts.cells;
    wideRays_ += counts.wide;
    misses_ += counts.missed;

    // Direct light there.
    if (counts.surfels > 0) {
        hitLight_.measure(context, sources_, surfels_, counts.surfels, params_.lightSamples,
                          batch.seed + 0xa3u + depth * 0x9e3779b9u, hitDirect_);
        stream.dispatch(reflect_, {{"surfels", surfels_}, {"arriving", hitDirect_}, {"light", light_}},
                        counts.surfels, linearGroups(counts.surfels));
    }
    return counts.next;
}

void GatherMirror::resolve(PassContext& context, const gpu::MirrorBatch& batch) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Image& lobes = context.has(lobes_) ? context.get(lobes_).reflected : black_;
    const Image& direct = context.has(otherDirect_) ? context.get(otherDirect_).image : black_;
    const Image& indirect = context.has(otherIndirect_) ? context.get(otherIndirect_).image : black_;
    context.stream.dispatch(resolve_,
                            {{"position", gbuffer.position, sampler_},
                             {"normal", gbuffer.normal, sampler_},
                             {"albedo", gbuffer.albedo, sampler_},
                             {"specular", gbuffer.specular, sampler_},
                             {"fresnel", gbuffer.fresnel, sampler_},
                             {"lobes", lobes, sampler_},
                             {"direct", direct, sampler_},
                             {"indirect", indirect, sampler_},
                             {"grazing", grazing_},
                             {"light", light_},
                             {"joinedDirect", context.get(direct_).image},
                             {"joinedIndirect", context.get(indirect_).image},
                             {"ends", context.get(ends_).parts}},
                            BatchPush{batch}, linearGroups(batch.pixels));
}

}  // namespace voxray

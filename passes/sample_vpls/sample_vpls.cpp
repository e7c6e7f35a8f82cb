#include "passes/sample_vpls/sample_vpls.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "shaders/light_paths/light_path_types.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPaths = 1u << 20;  // Bounds the memory of rays to 84 MiB.

struct RecordPush {
    gpu::VoxelGrid grid;
    uint32_t paths;
    uint32_t firstPath;
    uint32_t firstRay;
    uint32_t seed;
    uint32_t bounce;
    uint32_t bounces;
};

/// How many of `paths` each source sends: by its power, at least one.
std::vector<uint32_t> pathsBySource(const std::vector<LightSource>& sources, uint32_t paths) {
    const double power = totalPower(sources);
    std::vector<uint32_t> counts;
    for (const LightSource& source : sources)
        counts.push_back(std::max(1u, uint32_t(std::lround(paths * (double(source.power) / power)))));
    return counts;
}

/// The place of each path, source by source, where paths of all sources are mixed evenly: any run of places
/// then holds runs of each source's own numbers, which complement each other.
std::vector<uint32_t> orderOfPaths(const std::vector<uint32_t>& pathsOf) {
    std::vector<double> at;
    for (const uint32_t paths : pathsOf)
        for (uint32_t i = 0; i < paths; ++i) at.push_back((i + 0.5) / paths);
    std::vector<uint32_t> paths(at.size()), places(at.size());
    std::iota(paths.begin(), paths.end(), 0u);
    std::stable_sort(paths.begin(), paths.end(), [&](uint32_t a, uint32_t b) { return at[a] < at[b]; });
    for (uint32_t place = 0; place < paths.size(); ++place) places[paths[place]] = place;
    return places;
}

/// The same source among those that shine now, nullptr where it does not.
const LightSource* find(const std::vector<LightSource>& sources, const LightSource& source) {
    const auto found = std::ranges::find_if(sources, [&](const LightSource& other) {
        return other.kind == source.kind && other.light == source.light;
    });
    return found == sources.end() ? nullptr : &*found;
}

}  // namespace

void SampleVpls::declare(PassBuilder& builder) {
    if (params_.first == FirstVertices::Rsm) rsm_ = builder.read<Rsm>("rsm", "what lights see");
    if (params_.bounce == VplBounce::Svo) {
        voxels_ = builder.read<SurfaceVoxels>("voxels", "what rays of further bounces meet");
        voxelTracer_.emplace(VoxelWalk::Svo);
    }
    vpls_ = builder.write<Vpls>("vpls", "virtual point lights");
}

void SampleVpls::plan(PassPlan& plan) {
    sources_ = requireLightSources(*plan.frame.scene, kName);
    pathsOf_ = pathsBySource(sources_, params_.vplsPerBounce);
    Vpls& vpls = plan.get(vpls_);
    vpls.paths = std::accumulate(pathsOf_.begin(), pathsOf_.end(), 0u);
    vpls.areaPerPath = float(surfaceArea(plan.frame.scene->geometry) / vpls.paths);
    vpls.bounces = params_.bounces;
    vpls.lightBounces = params_.bounces;
    const uint64_t points = vpls.places(kName);
    const uint64_t batch = std::min(*std::max_element(pathsOf_.begin(), pathsOf_.end()), kBatchPaths);
    plan.buffer(vpls.points, "virtual point lights", points * sizeof(gpu::Vpl));
    plan.buffer(vpls.list, "list of virtual point lights", points * sizeof(uint32_t));
    plan.buffer(order_, "order of light paths", vpls.paths * sizeof(uint32_t));
    plan.buffer(flags_, "flags of virtual point lights", (points + 31) / 32 * sizeof(uint32_t));
    plan.reserveScratch("compaction of virtual point lights",
                        Compaction::scratchBytes(uint32_t((points + 31) / 32)));
    plan.scratchBuffer(rays_, "light rays", batch * sizeof(Ray));
    plan.scratchBuffer(hits_, "light ray hits", batch * sizeof(Hit));
    plan.scratchBuffer(paths_, "light paths", batch * sizeof(gpu::LightPath));
    tint_.plan(plan, batch);
    if (params_.first == FirstVertices::Rsm)
        rsmSampling_.plan(plan, plan.get(rsm_));
    else
        emission_.plan(plan, batch);
    if (voxelTracer_) voxelTracer_->plan(plan, plan.get(voxels_));
}

void SampleVpls::prepare(PassSetup& setup) {
    tint_.prepare(setup);
    if (params_.first == FirstVertices::Rsm)
        rsmSampling_.prepare(setup);
    else
        emission_.prepare(setup);
    const auto recordProgram = [&](const Defines& defines) {
        return makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/sample_vpls/record.comp", defines));
    };
    if (voxelTracer_) {
        voxelTracer_->prepare(setup.device, setup.compiler);
        record_ = recordProgram({{"VOXEL_NEXT", "1"}});
        recordVoxels_ = recordProgram({{"VOXEL_HITS", "1"}, {"VOXEL_NEXT", "1"}});
    } else {
        record_ = recordProgram({});
    }
    const std::vector<uint32_t> order = orderOfPaths(pathsOf_);
    setup.stream.upload(order_, std::as_bytes(std::span(order)));
    compaction_.emplace(setup.device, setup.compiler);
}

void SampleVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    Vpls& vpls = context.get(vpls_);
    const std::vector<LightSource> shining = lightSources(*context.frame.scene);
    for (const LightSource& source : shining)
        if (!find(sources_, source))
            throw Error(
                "{}: a light began to shine after the first frame, when paths were divided among lights",
                kName);
    stream.fill(flags_, 0);
    stream.fill(vpls.points, 0);
    RayTracer* furtherTracer = &context.tracer;
    std::vector<Binding> ofVoxels;
    gpu::VoxelGrid grid{};
    if (voxelTracer_) {
        const SurfaceVoxels& voxels = context.get(voxels_);
        voxelTracer_->begin(stream, voxels);
        furtherTracer = &*voxelTracer_;
        ofVoxels = voxels.bindings({});
        grid = voxels.grid;
    }
    const uint64_t voxelRaysBefore = voxelTracer_ ? voxelTracer_->raysTraced() : 0;

    // The paths of each light in batches, hit after hit. One that was switched off sends none
    uint32_t firstPath = 0;
    for (uint32_t s = 0; s < sources_.size(); firstPath += pathsOf_[s], ++s) {
        const LightSource* source = find(shining, sources_[s]);
        if (!source) continue;
        const auto number = uint32_t(s + (params_.resample ? context.frameIndex * sources_.size() : 0));
        LightEmission::Batch batch{randomSeed(context.frame, number), pathsOf_[s], 0, 0};
        const bool areHitsKnown = params_.first == FirstVertices::Rsm;
        for (; batch.first < batch.rays; batch.first += batch.count) {
            batch.count = std::min(batch.rays - batch.first, kBatchPaths);
            if (areHitsKnown)
                rsmSampling_.emit(context, context.get(rsm_), s, {rays_, hits_, paths_, batch});
            else
                emission_.emit(context, *source, batch, rays_, paths_);
            for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
                if (bounce > 0)
                    furtherTracer->closestHit(stream, rays_, hits_, batch.count);
                else if (!areHitsKnown)
                    context.tracer.closestHit(stream, rays_, hits_, batch.count);
                if (bounce == 0)
                    tint_.apply(context, rays_, paths_, sizeof(gpu::LightPath) / sizeof(float), batch.count,
                                &hits_);
                std::vector<Binding> bindings = context.scene.bindings({{"rays", rays_},
                                                                        {"hits", hits_},
                                                                        {"paths", paths_},
                                                                        {"order", order_},
                                                                        {"VplsAt", vpls.points.at()},
                                                                        {"flags", flags_}});
                bindings.insert(bindings.end(), ofVoxels.begin(), ofVoxels.end());
                stream.dispatch(bounce > 0 && voxelTracer_ ? recordVoxels_ : record_, bindings,
                                RecordPush{grid, batch.count, firstPath + batch.first, batch.first,
                                           batch.seed, bounce, params_.bounces},
                                linearGroups(batch.count));
            }
        }
    }
    if (voxelTracer_) {
        context.extraRays += voxelTracer_->raysTraced() - voxelRaysBefore;
        context.voxelCounts.push_back(&voxelTracer_->march().counts());
    }
    vpls.count = compaction_->run(stream, flags_, vpls.list, uint32_t(flags_.bytes() / sizeof(uint32_t)));
    context.report("vpls", vpls.count);
    if (vpls.count == 0 && !shining.empty())
        throw Error(
            "{}: none of {} rays from the lights hit a surface that reflects light; let lights shine on "
            "the scene, or raise 'vpls_per_bounce'",
            kName, vpls.paths);
}

}  // namespace voxray

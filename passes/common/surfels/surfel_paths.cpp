#include "passes/common/surfels/surfel_paths.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct GatherPush {
    uint32_t count;
    uint32_t ray;
    uint32_t rays;
    uint32_t seed;
};

struct ArrivePush {
    gpu::VoxelGrid grid;
    uint32_t rayCount;
    uint32_t firstId;
    uint32_t fromSurfels;
    uint32_t seed;
    glm::vec3 forward;  ///< This and what follows: SurfelPaths::CameraFootprint.
    float imageArea;
    float maxArea;
};

struct WritePush {
    uint32_t count;
    float scale;
};

}  // namespace

void SurfelPaths::plan(PassPlan& plan, const Settings& settings) {
    settings_ = settings;
    const uint64_t batch = settings.batch;
    light_.plan(plan, settings.batch);
    plan.buffer(rays_, "path rays", batch * sizeof(Ray));
    plan.buffer(hits_, "path hits", batch * sizeof(Hit));
    plan.buffer(count_, "number of surfels", sizeof(uint32_t));
    levels_ = std::vector<Level>(settings.levels());
    for (Level& level : levels_) {
        plan.buffer(level.surfels, "surfels", batch * sizeof(gpu::Surfel));
        plan.buffer(level.direct, "surfels' direct irradiance", batch * 4 * sizeof(float));
        plan.buffer(level.indirect, "surfels' indirect irradiance", batch * 4 * sizeof(float));
    }
}

void SurfelPaths::prepare(PassSetup& setup) {
    light_.prepare(setup);
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    gather_ = program("passes/common/surfels/surfel_gather.comp");
    arrive_ = program("passes/common/surfels/surfel_arrive.comp");
    return_ = program("passes/common/surfels/surfel_return.comp");
    write_ = program("passes/common/surfels/surfel_write.comp", VoxelAccumulator::defines(settings_.write));
}

uint32_t SurfelPaths::makeSurfels(PassContext& context, const SurfaceVoxels& voxels, const Buffer& rays,
                                  const Buffer& hits, const Buffer& parents, const Buffer& surfels,
                                  uint32_t count, uint32_t firstId, bool fromSurfels, uint32_t seed,
                                  const CameraFootprint& camera) {
    context.stream.fill(count_, 0);
    context.stream.dispatch(
        arrive_,
        voxels.bindings(context.scene.bindings(
            {{"rays", rays}, {"hits", hits}, {"parents", parents}, {"surfels", surfels}, {"count", count_}})),
        ArrivePush{voxels.grid, count, firstId, fromSurfels, seed, camera.forward, camera.imageArea,
                   camera.maxArea},
        linearGroups(count));
    return context.stream.readAs<uint32_t>(count_, 1)[0];
}

uint32_t SurfelPaths::arrive(PassContext& context, const SurfaceVoxels& voxels, const CameraFootprint& camera,
                             const Buffer& rays, const Buffer& hits, uint32_t count, uint32_t firstId) {
    // No parents: any buffer stands for them.
    return makeSurfels(context, voxels, rays, hits, levels_.back().surfels, levels_[0].surfels, count,
                       firstId, false, 0, camera);
}

void SurfelPaths::run(PassContext& context, const std::vector<LightSource>& sources, uint32_t count,
                      uint32_t seed, const Targets& targets) {
    CommandStream& stream = context.stream;

    // Out: direct light at each surfel, and its one ray on.
    levels_[0].count = count;
    size_t depth = 0;
    for (;; ++depth) {
        Level& level = levels_[depth];
        const uint32_t levelSeed = seed + uint32_t(depth) * 0x9e3779b9u;
        light_.measure(context, sources, level.surfels, level.count, settings_.lightSamples, levelSeed,
                       level.direct);
        stream.fill(level.indirect, 0);
        if (depth + 1 == levels_.size()) break;
        stream.dispatch(gather_, {{"surfels", level.surfels}, {"rays", rays_}},
                        GatherPush{level.count, 0, 1, levelSeed + 0x51u}, linearGroups(level.count));
        context.tracer.closestHit(stream, rays_, hits_, level.count);
        Level& next = levels_[depth + 1];
        next.count = makeSurfels(context, targets.voxels, rays_, hits_, level.surfels, next.surfels,
                                 level.count, 0, true, levelSeed + 0xa3u, {});
        if (next.count == 0) break;
    }

    // Back: what each surfel reflects reaches its parent; then leave it in the voxels. Surfels that the first
    // ones see take as many bounces as those, hence a second way back from one level deeper.
    for (size_t first = 0; first <= std::min<size_t>(depth, settings_.secondary ? 1 : 0); ++first) {
        for (size_t d = std::min(first + settings_.bounces, depth); d > first; --d)
            stream.dispatch(return_,
                            {{"surfels", levels_[d].surfels},
                             {"direct", levels_[d].direct},
                             {"indirect", levels_[d].indirect},
                             {"parentIndirect", levels_[d - 1].indirect}},
                            levels_[d].count, linearGroups(levels_[d].count));
        const Level& level = levels_[first];
        const auto write = [&](const VoxelAccumulator& writes, const Buffer& irradiance) {
            std::vector<Binding> bindings = writes.bindings();
            bindings.push_back({"surfels", level.surfels});
            bindings.push_back({"irradiance", irradiance});
            stream.dispatch(write_, bindings, WritePush{level.count, writes.scale()},
                            linearGroups(level.count));
        };
        write(targets.direct, level.direct);
        write(targets.indirect, level.indirect);
    }
}

}  // namespace voxray

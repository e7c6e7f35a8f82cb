#pragma once

#include <limits>
#include <vector>

#include "graph/memory_plan.h"
#include "passes/common/voxels/voxels.h"
#include "tests/support/programs.h"

namespace voxray::test {

/// Does for `walker`, a VoxelMarch or a VoxelTracer of `programs`, what a graph does for a pass: makes what
/// it describes for rays through `voxels`, and compiles.
template <typename Walker>
void prepare(TestPrograms& programs, Walker& walker, const SurfaceVoxels& voxels) {
    MemoryPlan plan;
    walker.plan(plan, voxels);
    for (const MemoryPlan::Allocation& allocation : plan.allocations()) allocation.make(device());
    programs.compile();
}

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <typename Tracer>
std::vector<Hit> closestHits(CommandStream& stream, Tracer& tracer, const std::vector<Ray>& rays) {
    const Buffer in(device(), "rays", rays.size() * sizeof(Ray)), out(device(), "hits", rays.size() * sizeof(Hit));
    stream.upload(in, rays);
    tracer.closestHit(stream, in, out, uint32_t(rays.size()));
    return stream.readAs<Hit>(out, rays.size());
}

}  // namespace voxray::test

#pragma once

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

}  // namespace voxray::test

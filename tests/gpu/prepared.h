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
    SurfaceVoxels planned;  // Of the same grid; how many voxels it expects is told to graphs alone.
    planned.grid = voxels.grid;
    planned.expectedCounts.resize(gridLevels(voxels.grid.resolution));
    walker.plan(plan, planned);
    for (const MemoryPlan::Part& part : plan.parts())
        if (part.make) part.make(device());
    programs.compile();
}

}  // namespace voxray::test

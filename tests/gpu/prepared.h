#pragma once

#include "graph/memory_plan.h"
#include "passes/common/voxels/voxels.h"
#include "tests/support/device.h"

namespace voxray::test {

/// Does for `walker`, a VoxelMarch or a VoxelTracer, what a graph does for a pass: makes what it describes
/// for rays through `voxels`, then prepares it.
template <typename Walker>
void prepare(Walker& walker, const SurfaceVoxels& voxels, const ShaderCompiler& compiler) {
    MemoryPlan plan;
    SurfaceVoxels planned;  // Of the same grid; how many voxels it expects is told to graphs alone.
    planned.grid = voxels.grid;
    planned.expectedCounts.resize(gridLevels(voxels.grid.resolution));
    walker.plan(plan, planned);
    for (const MemoryPlan::Part& part : plan.parts())
        if (part.make) part.make(device());
    walker.prepare(device(), compiler);
}

}  // namespace voxray::test

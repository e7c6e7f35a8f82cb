#pragma once

#include <vector>

#include "passes/probes/probe_types.h"
#include "scene/geometry.h"

namespace voxray {

/// Where probes are: cascades of equally many, each with twice the spacing of the one before. The last covers
/// the scene's region; the others are round the camera. Axes have spacings of their own.
struct ProbeLattice {
    glm::uvec3 counts{1};
    std::vector<gpu::ProbeGrid> grids;  ///< From the finest to the coarsest.

    uint32_t cascadeSize() const { return counts.x * counts.y * counts.z; }
    uint32_t size() const { return cascadeSize() * uint32_t(grids.size()); }
};

/// @param probes along the region's longest side. @param margin of the outermost probes from the region's sides, in
/// spacings.
ProbeLattice makeProbeLattice(const Box& region, uint32_t probes, uint32_t cascades, float margin);

/// Moves all but the coarsest cascade by whole spacings, so that the camera is in their middle.
void centerProbes(ProbeLattice& lattice, const glm::vec3& camera);

/// Numbers of the probes (probeNumber() of probe_grid.glsl) that a lattice has at points where `before` had none.
std::vector<uint32_t> freshProbes(const ProbeLattice& lattice, const ProbeLattice& before);

}  // namespace voxray

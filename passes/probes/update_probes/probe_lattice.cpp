#include "passes/probes/update_probes/probe_lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>

namespace voxray {
namespace {

glm::ivec3 remainder(glm::ivec3 k, glm::ivec3 counts) {
    return (k % counts + counts) % counts;
}

}  // namespace

ProbeLattice makeProbeLattice(const Box& region, uint32_t probes, uint32_t cascades, float margin) {
    const glm::vec3 size = region.max - region.min;
    const float part = std::max({size.x, size.y, size.z, 1e-6f}) / float(probes);
    ProbeLattice lattice;
    gpu::ProbeGrid grid{};
    for (int axis = 0; axis < 3; ++axis) {
        // Along the longest side a whole number of parts but for rounding
        const uint32_t count = std::max(uint32_t(std::ceil(size[axis] / part - 1e-3f)), 1u);
        const float parts = float(count) - 1 + 2 * margin;
        lattice.counts[axis] = count;
        grid.spacing[axis] = count > 1 ? size[axis] / parts : part;
        grid.origin[axis] =
            count > 1 ? region.min[axis] + margin * grid.spacing[axis] : 0.5f * (region.min[axis] + region.max[axis]);
    }
    grid.minSpacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    for (uint32_t c = 0; c < cascades; ++c) {
        lattice.grids.push_back(grid);
        const float scale = std::ldexp(1.0f, int(c + 1) - int(cascades));
        lattice.grids[c].spacing *= scale;
        lattice.grids[c].minSpacing *= scale;
    }
    return lattice;
}

void centerProbes(ProbeLattice& lattice, const glm::vec3& camera) {
    for (size_t c = 0; c + 1 < lattice.grids.size(); ++c) {
        gpu::ProbeGrid& grid = lattice.grids[c];
        const glm::vec3 middle = (camera - grid.origin) / grid.spacing - 0.5f * (glm::vec3(lattice.counts) - 1.0f);
        grid.first = glm::ivec3(glm::round(middle));
    }
}

std::vector<uint32_t> freshProbes(const ProbeLattice& lattice, const ProbeLattice& before) {
    std::vector<uint32_t> fresh;
    const glm::ivec3 counts(lattice.counts);
    for (size_t c = 0; c < lattice.grids.size(); ++c) {
        const glm::ivec3 first = lattice.grids[c].first, old = before.grids[c].first;
        if (first == old) continue;
        glm::ivec3 k;
        for (k.z = first.z; k.z < first.z + counts.z; ++k.z)
            for (k.y = first.y; k.y < first.y + counts.y; ++k.y)
                for (k.x = first.x; k.x < first.x + counts.x; ++k.x) {
                    if (glm::all(glm::greaterThanEqual(k, old)) && glm::all(glm::lessThan(k, old + counts))) continue;
                    const glm::ivec3 slot = remainder(k, counts);
                    fresh.push_back(uint32_t(((int(c) * counts.z + slot.z) * counts.y + slot.y) * counts.x + slot.x));
                }
    }
    return fresh;
}

}  // namespace voxray

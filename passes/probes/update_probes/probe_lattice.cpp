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

ProbeLattice makeProbeLattice(const Box& region, uint32_t probes, uint32_t cascades) {
    const glm::vec3 size = region.max - region.min;
    const float spacing = std::max({size.x, size.y, size.z, 1e-6f}) / float(probes);
    ProbeLattice lattice;
    // The region's longest side is a whole number of spacings but for rounding
    lattice.counts = glm::max(glm::uvec3(glm::ceil(size / spacing - 1e-3f)), glm::uvec3(1));
    const glm::vec3 center = 0.5f * (region.min + region.max);
    const glm::vec3 origin = center - 0.5f * spacing * (glm::vec3(lattice.counts) - 1.0f);
    for (uint32_t c = 0; c < cascades; ++c)
        lattice.grids.push_back({origin, std::ldexp(spacing, int(c + 1) - int(cascades)), glm::ivec3(0)});
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

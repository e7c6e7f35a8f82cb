#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace voxray {

/// One face of one voxel.
struct FaceSample {
    glm::ivec3 voxel{};       ///< In the grid: 0 to 1023.
    double area = 0;          ///< In units of a voxel's face.
    glm::dvec3 irradiance{};  ///< W/m²
    double errorScale = 1;    ///< W/m², positive: errors are relative to this.
};

/// A k-d tree over samples whose leaves hold their mean (packed: irradiance_tree_types.h).
struct SampleTree {
    std::vector<uint32_t> words;
    uint32_t leaves = 0;
    /// Squared relative error that leaves make, summed over samples and weighted by their areas.
    double squaredError = 0;
};

/// Grows a tree by splits along the axes, each of which lowers the squared relative error most, down to
/// single voxels; then prunes it from the leaves up: a subtree stays where the leaves that it adds lower the
/// squared error, weighted by area, by more than `tolerance`² voxel faces each, on average. Of all prunings
/// this has the least error for its number of leaves (Breiman et al. 1984, cost-complexity pruning; Chou,
/// Lookabaugh and Gray 1989). A leaf's irradiance is its flux over its area, so that flux is kept. No leaf
/// holds samples of irradiance 0 together with others.
/// @param samples of one face; reordered. @throws Error where the words outgrow what offsets can tell.
SampleTree buildSampleTree(std::vector<FaceSample>& samples, double tolerance);

}  // namespace voxray

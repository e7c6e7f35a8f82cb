#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace voxray {

/// A face of a voxel.
struct FaceSample {
    glm::ivec3 voxel{};       ///< 0 to 1023.
    double area = 0;          ///< In units of a voxel's face.
    glm::dvec3 irradiance{};  ///< W/m²
    double errorScale = 1;    ///< W/m², positive: errors are relative to it.
};

/// A k-d tree whose leaves hold the mean of their samples (irradiance_tree_types.h).
struct SampleTree {
    std::vector<uint32_t> words;
    uint32_t leaves = 0;
    double squaredError = 0;  ///< Squared relative error, summed over samples, weighted by area.
};

/// Builds a tree top down to single voxels by the splits that reduce the squared relative error most, then
/// prunes it bottom up: a subtree remains where its additional leaves reduce the squared error, weighted by
/// area, by more than `tolerance`² voxel faces per leaf. Of all prunings this has the least error for its
/// number of leaves (Breiman et al. 1984, cost-complexity pruning; Chou, Lookabaugh and Gray 1989). A leaf's
/// irradiance is its flux over its area, which preserves flux. No leaf mixes black samples with others.
/// @param samples of one face direction; reordered. @throws Error where offsets between nodes do not fit.
SampleTree buildSampleTree(std::vector<FaceSample>& samples, double tolerance);

}  // namespace voxray

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "passes/cones/clipmap/clipmap_windows.h"
#include "tests/gpu/radiance_samples.h"

namespace voxray::test {

/// What a weight of the sampler may be off by along an axis, where it is cut off; half of that where rounded.
inline double weightError() {
    return std::exp2(-double(device().properties().limits.subTexelPrecisionBits));
}

/// What cones gather of texels that the sampler filters, next to what they gather by our filter: a sample is
/// off by two weights' error of what lies round it, the light of a cone is a mean of samples.
inline void expectSameLight(const ImageF& ours, const ImageF& sampled, const std::string& directions) {
    double squares = 0;
    for (size_t i = 0; i < ours.data.size(); ++i) squares += std::pow(double(sampled.data[i]) - ours.data[i], 2);
    const double difference = std::sqrt(squares / double(ours.data.size())) / mean(ours);
    const double ratio = mean(sampled) / mean(ours);
    std::printf("%s directions: mean ratio %.6f, root mean square difference %.2g of the mean\n", directions.c_str(),
                ratio, difference);
    EXPECT_NEAR(ratio, 1.0, 2 * weightError());
    EXPECT_LT(difference, 2 * weightError());
}

/// The Cornell box, 2 m wide, seen from `camera`.
inline State cornellFrom(const glm::vec3& camera) {
    const auto state = builtin("cornell", "{lights: point}");
    state->cameras.at(0).position = camera;
    return state;
}

/// A place in the center of a layer across `axis`, as cones read it, in voxels of a level.
struct LayerPlace {
    glm::vec3 voxels;
    uint32_t level;
    int axis;
    float sign;  ///< Of the ray's direction along the axis.
};

/// Anywhere in what is held of each level and up to two voxels outside.
inline std::vector<LayerPlace> randomPlaces(const gpu::RadianceGrid& grid, size_t count,
                                            const std::function<VoxelBox(uint32_t level)>& held) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<LayerPlace> places(count);
    for (LayerPlace& p : places) {
        p.level = random() % grid.levels;
        p.axis = int(random() % 3);
        p.sign = random() % 2 ? 1.0f : -1.0f;
        const VoxelBox box = held(p.level);
        for (int k = 0; k < 3; ++k) p.voxels[k] = float(box.first[k]) + float(box.size[k] + 4) * uniform(random) - 2.5f;
        p.voxels[p.axis] = std::floor(p.voxels[p.axis]);
    }
    return places;
}

/// Anywhere in the grid and up to two voxels outside.
inline std::vector<LayerPlace> randomPlaces(const gpu::RadianceGrid& grid, size_t count) {
    return randomPlaces(grid, count, [&](uint32_t level) {
        return VoxelBox{glm::ivec3(0), levelResolution(grid.resolution, level)};
    });
}

inline RadianceQuery queryAt(const gpu::RadianceGrid& grid, const LayerPlace& p, glm::vec3 voxels) {
    const float voxel = grid.voxelSize * float(1u << p.level);
    glm::vec3 direction(0.0f);
    direction[p.axis] = p.sign;
    return {grid.origin + voxel * (voxels + 0.5f), voxel, direction};
}

inline std::vector<RadianceQuery> queriesAt(const gpu::RadianceGrid& grid, const std::vector<LayerPlace>& places) {
    std::vector<RadianceQuery> queries;
    for (const LayerPlace& p : places) queries.push_back(queryAt(grid, p, p.voxels));
    return queries;
}

/// Of each place the twelve voxels that a filter may read: two along each of the axes across, and the layers
/// before and after, since a weight of 0 may be off as well.
constexpr size_t kVoxelsRound = 12;
inline std::vector<RadianceQuery> voxelsRound(const gpu::RadianceGrid& grid, const std::vector<LayerPlace>& places) {
    std::vector<RadianceQuery> queries;
    for (const LayerPlace& p : places) {
        const int u = (p.axis + 1) % 3, v = (p.axis + 2) % 3;
        for (int i = 0; i < int(kVoxelsRound); ++i) {
            glm::vec3 at = glm::floor(p.voxels);
            at[u] += float(i % 2);
            at[v] += float(i / 2 % 2);
            at[p.axis] += float(i / 4 - 1);
            queries.push_back(queryAt(grid, p, at));
        }
    }
    return queries;
}

/// Plans a graph for the Cornell box on a device whose filtered volumes may have `side` texels.
inline void planWithVolumes(uint32_t side, const std::string& graph) {
    const auto state = builtin("cornell", "{lights: point}");
    Frame frame;
    frame.scene = state.get();
    frame.camera = state->cameras.at(0);
    frame.width = frame.height = 8;
    DeviceInfo info = device().info();
    info.filteredVolumeSide = side;
    Graph(allPasses(), parseYaml(graph, "graph")).plan(frame, info, device().memoryLimitBytes());
}

/// What minimumLevel() of passes/cones/radiance/radiance_clipmap.glsl answers.
inline float minimumLevel(const ClipmapWindows& windows, const gpu::RadianceGrid& grid, const glm::vec3& camera,
                          glm::vec3 position) {
    position = glm::clamp(position, grid.origin, grid.origin + grid.voxelSize * glm::vec3(grid.resolution));
    for (uint32_t level = 0; level < windows.firstWhole(); ++level) {
        const gpu::ClipmapWindow w = windows.window(level, camera);
        const glm::vec3 left = w.reach - glm::abs(position - w.center);
        const float weight = std::min({left.x, left.y, left.z}) * w.falloff;
        if (weight > 0) return float(level) + std::max(1 - weight, 0.0f);
    }
    return float(windows.firstWhole());
}

}  // namespace voxray::test

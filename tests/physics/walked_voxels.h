#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "passes/common/voxel_march/voxel_tracer.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/prepared.h"
#include "tests/physics/made_up_voxels.h"

namespace voxray::test {

/// As in tests/gpu/voxel_march.comp.
struct WalkAnswer {
    glm::ivec3 start, end;
    uint32_t hit;
    glm::ivec3 voxel;
    uint32_t face;
    float t;
    uint32_t steps;
    bool operator==(const WalkAnswer&) const = default;
};

/// Made-up voxels, and rays through them by any walk.
class WalkedVoxels {
 public:
    WalkedVoxels(glm::uvec3 resolution, float voxelSize, const std::function<bool(glm::ivec3)>& occupied)
        : stream_(device()) {
        grid = madeUpGrid(resolution, voxelSize);
        voxels_ = madeUpVoxels(stream_, grid, [&](glm::ivec3 v) {
            bits_.push_back(occupied(v));
            return bool(bits_.back());
        });
    }

    bool occupied(glm::ivec3 v) const {
        const glm::ivec3 size(grid.resolution);
        return bits_[(size_t(v.z) * size_t(size.y) + size_t(v.y)) * size_t(size.x) + size_t(v.x)];
    }

    /// @param segments whether both ways of occlusion are asked for (in WalkAnswer::hit), instead of the
    /// closest voxel.
    std::vector<WalkAnswer> walk(VoxelTraversal walk, const std::vector<Ray>& rays, float epsilon = 0,
                                 bool segments = false) {
        TestPrograms programs;
        VoxelMarch march(programs, walk, epsilon);
        Kernel kernel(programs, "tests/gpu/voxel_march.comp", march.defines());
        if (segments) kernel.define({{"SEGMENTS", "1"}});
        prepare(programs, march, voxels_);
        march.begin(stream_, voxels_);
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray));
        const Buffer out(device(), "answers", rays.size() * sizeof(WalkAnswer));
        stream_.upload(in, rays);
        stream_.dispatch(kernel, rays.size(),
                         {march, {"rays", in}, {"answers", out}, {"grid", grid}, {"count", uint32_t(rays.size())}});
        counts = stream_.readAs<uint64_t>(march.counts(), 2);
        return stream_.readAs<WalkAnswer>(out, rays.size());
    }

    /// By a stream of rays.
    std::vector<Hit> closestHits(VoxelTraversal walk, const std::vector<Ray>& rays) {
        TestPrograms programs;
        VoxelTracer tracer(programs, walk);
        prepare(programs, tracer, voxels_);
        tracer.begin(stream_, voxels_);
        return test::closestHits(stream_, tracer, rays);
    }

    gpu::VoxelGrid grid{};
    std::vector<uint64_t> counts;  ///< Steps and visits of the last walk.

 private:
    CommandStream stream_;
    std::vector<bool> bits_;
    SurfaceVoxels voxels_;
};

inline std::vector<Ray> raysThroughGrid(const gpu::VoxelGrid& grid, size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    const glm::vec3 extent = glm::vec3(grid.resolution) * grid.voxelSize;
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        Ray& ray = rays[i];
        for (int axis = 0; axis < 3; ++axis)
            ray.origin[axis] = grid.origin[axis] + extent[axis] * (1.4f * uniform(random) - 0.2f);
        ray.direction = glm::vec3(normal(random), normal(random), normal(random));
        ray.tMin = i % 3 == 0 ? uniform(random) * extent.x / 4 : 0.0f;
        ray.tMax = i % 2 == 0 ? kInfinity : ray.tMin + uniform(random) * extent.x;
    }
    return rays;
}

inline bool isSparse(glm::ivec3 v, uint32_t inThousand) {
    uint32_t hash = uint32_t(v.x) * 0x9e3779b1u ^ uint32_t(v.y) * 0x85ebca77u ^ uint32_t(v.z) * 0xc2b2ae3du;
    hash ^= hash >> 15, hash *= 0x2c1b3c6du, hash ^= hash >> 12, hash *= 0x297a2d39u, hash ^= hash >> 15;
    return hash % 1000 < inThousand;
}

/// Voxels here and there; a hollow sphere; and nearly nothing, in which steps are large.
inline WalkedVoxels sparseVoxels() {
    return WalkedVoxels({130, 37, 201}, 0.09f, [](glm::ivec3 v) { return isSparse(v, 8); });
}
inline WalkedVoxels sphereVoxels() {
    return WalkedVoxels(glm::uvec3(128), 0.125f, [](glm::ivec3 v) {
        return std::abs(glm::length(glm::dvec3(v) + 0.5 - 64.0) - 50) < 0.7 || v == glm::ivec3(64);
    });
}
/// As long as walks take, for what is rounded far from the origin.
inline WalkedVoxels longVoxels() {
    return WalkedVoxels({1024, 11, 18}, 0.02f, [](glm::ivec3 v) { return isSparse(v, 3); });
}
inline WalkedVoxels emptyVoxels() {
    return WalkedVoxels({250, 256, 64}, 0.02f, [](glm::ivec3 v) { return isSparse(v / 16, 80) && isSparse(v, 60); });
}

}  // namespace voxray::test

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <random>

#include "passes/hybrid_leaves/hybrid_tracer.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/prepared.h"
#include "tests/gpu/trace_scenes.h"
#include "tests/support/places.h"

namespace voxray::test {

/// A scene's hybrid leaves, and rays through them.
class Hybrid {
 public:
    Hybrid(const State& state, uint32_t resolution, const std::string& parameters)
        : chain_(state,
                 graphYaml({fmt::format("voxelize, resolution: {}, visibility_rays: 0", resolution),
                            "build_hybrid_leaves, " + parameters}),
                 16, 16),
          compiler_(sourceRoot(), shaderCache()),
          stream_(device()),
          scene_(makeGpuScene(device(), stream_, *state)),
          state_(state) {}

    const SurfaceVoxels& voxels() const { return chain_.get<SurfaceVoxels>("voxels"); }
    const HybridLeaves& leaves() const { return chain_.get<HybridLeaves>("hybrid_leaves"); }
    Chain& chain() { return chain_; }

    /// @param start what all rays leave behind. @param maxWidth m, beyond which rays end.
    std::vector<Hit> closest(HybridTraversal walk, const std::vector<Ray>& rays,
                             const std::optional<gpu::RayStart>& start = {}, float maxWidth = kInfinity) {
        TestPrograms programs;
        HybridTracer tracer(programs, walk);
        prepare(programs, tracer, voxels());
        tracer.begin(stream_, scene_, voxels(), leaves(), maxWidth);
        const std::vector<Hit> hits = start ? closestFrom(tracer, rays, *start) : closestHits(stream_, tracer, rays);
        counts = stream_.readAs<uint64_t>(tracer.counts(), 2);
        tests = stream_.readAs<uint64_t>(tracer.testCounts(), 1)[0];
        return hits;
    }
    std::vector<Hit> embree(const std::vector<Ray>& rays) {
        return closestHits(stream_, *makeRayTracer(TracerKind::Embree, device(), compiler_, *state_), rays);
    }

    std::vector<uint64_t> counts;  ///< Steps and visits of the last stream.
    uint64_t tests = 0;            ///< Of triangles.

 private:
    std::vector<Hit> closestFrom(HybridTracer& tracer, const std::vector<Ray>& rays, gpu::RayStart start) {
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray)),
            starts(device(), "starts", rays.size() * sizeof(start)), out(device(), "hits", rays.size() * sizeof(Hit));
        stream_.upload(in, rays);
        stream_.upload(starts, std::vector<gpu::RayStart>(rays.size(), start));
        tracer.setStarts(&starts);
        tracer.closestHit(stream_, in, out, uint32_t(rays.size()));
        tracer.setStarts(nullptr);
        return stream_.readAs<Hit>(out, rays.size());
    }

    Chain chain_;
    ShaderCompiler compiler_;
    CommandStream stream_;
    GpuScene scene_;
    State state_;
};

/// Rays from points in a scene's bounds, everywhere; every third begins beyond its origin or ends early.
inline std::vector<Ray> raysThrough(const Geometry& geometry, size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    const glm::vec3 extent = geometry.boundsMax - geometry.boundsMin;
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        Ray& ray = rays[i];
        for (int axis = 0; axis < 3; ++axis)
            ray.origin[axis] = geometry.boundsMin[axis] + extent[axis] * (1.2f * uniform(random) - 0.1f);
        ray.direction = glm::vec3(normal(random), normal(random), normal(random));
        ray.tMin = i % 3 == 0 ? 0.1f * uniform(random) * extent.x : 0.0f;
        ray.tMax = i % 3 == 1 ? uniform(random) * extent.x : kInfinity;
    }
    return rays;
}

/// The part of rays that meet another triangle than Embree says, at another distance.
inline double differing(const std::vector<Hit>& expected, const std::vector<Hit>& found) {
    size_t different = 0, hits = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        hits += expected[i].triangle != Hit::kMiss;
        if (expected[i].triangle == found[i].triangle) continue;
        // Of triangles at the same distance either may be met.
        if (expected[i].triangle == Hit::kMiss || found[i].triangle == Hit::kMiss ||
            std::abs(expected[i].t - found[i].t) > 1e-5f * (1 + expected[i].t))
            ++different;
    }
    EXPECT_GT(hits, found.size() / 8);
    return double(different) / double(found.size());
}

inline bool isCell(const Hit& hit) {
    return hit.triangle != Hit::kMiss && hit.triangle >= HIT_IS_CELL;
}

/// What a grid's cell holds.
struct CellValue {
    glm::vec3 normal, albedo;
};

/// As in passes/hybrid_leaves/grid_cell.glsl.
inline CellValue unpackCell(const uint32_t* words) {
    const auto snorm = [](uint32_t bits) { return std::max(float(int16_t(bits)) / 32767.0f, -1.0f); };
    glm::vec3 n(snorm(words[0] & 0xffffu), snorm(words[0] >> 16), 0);
    n.z = 1 - std::abs(n.x) - std::abs(n.y);
    if (n.z < 0) {
        const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(n.y, n.x));
        n.x = n.x >= 0 ? folded.x : -folded.x;
        n.y = n.y >= 0 ? folded.y : -folded.y;
    }
    const uint32_t a = words[1];
    return {glm::normalize(n),
            glm::vec3(float(a & 2047u), float(a >> 11 & 2047u), float(a >> 22)) / glm::vec3(2047, 2047, 1023)};
}

/// A soup of triangles with alpha masks and degenerate triangles, every third one twice, and two that are no
/// triangles.
inline std::shared_ptr<SceneState> soup() {
    SceneState state = triangleSoup(1500, 0.12f, 1);
    for (size_t t = 0; t < 1500; t += 3) {
        state.geometry.triangles.push_back(state.geometry.triangles[t]);
        state.geometry.triangleMaterials.push_back(state.geometry.triangleMaterials[t]);
    }
    for (const float corner : {std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
        const uint32_t first = uint32_t(state.geometry.positions.size());
        for (const glm::vec3 position : {glm::vec3(0), glm::vec3(0.1f, 0, 0), glm::vec3(0, corner, 0)}) {
            state.geometry.positions.push_back(position);
            state.geometry.attributes.emplace_back();
        }
        state.geometry.triangles.emplace_back(first, first + 1, first + 2);
        state.geometry.triangleMaterials.push_back(0);
    }
    state.cameras.emplace_back();
    return std::make_shared<SceneState>(std::move(state));
}

/// A plane of many small triangles, of two colours one upon the other where `twice`.
inline State mesh(glm::vec3 edgeU, glm::vec3 edgeV, bool twice) {
    SceneBuilder b("mesh");
    const uint32_t first = b.lambert("first", {0.2f, 0.4f, 0.9f}), second = b.lambert("second", {0.6f, 0.4f, 0.1f});
    constexpr int kSide = 32;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec3 u = edgeU / float(kSide), v = edgeV / float(kSide);
        const glm::vec3 corner = -0.5f * (edgeU + edgeV) + u * float(i % kSide) + v * float(i / kSide);
        b.quad("quad", corner, u, v, first);
        if (twice) b.quad("quad", corner, u, v, second);
    }
    b.box("box", {0, -0.5f, 0}, glm::vec3(0.05f), 0.3f, first);
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    return evaluated(b);
}

}  // namespace voxray::test

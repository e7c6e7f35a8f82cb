// Leaves of hybrid octrees against brute force on the host, and rays through them against Embree.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <random>
#include <set>

#include "passes/common/hybrid_leaves/hybrid_tracer.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/prepared.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::shared_ptr<const SceneState> builtin(const std::string& scene, const std::string& parameters = "{}") {
    return std::make_shared<SceneState>(
        evaluate(makeBuiltinScene(scene, parseYaml(parameters, "scene")), 0.0));
}

/// A scene's hybrid leaves, and rays through them.
class Hybrid {
 public:
    Hybrid(const std::shared_ptr<const SceneState>& state, uint32_t resolution, const std::string& parameters)
        : chain_(state,
                 graphYaml({fmt::format("voxelize, resolution: {}, visibility_rays: 0", resolution),
                            "build_hybrid_leaves, " + parameters}),
                 16, 16, 1),
          compiler_(VOXRAY_SOURCE_DIR, VOXRAY_TEST_CACHE),
          stream_(device()),
          scene_(makeGpuScene(device(), stream_, *state)),
          state_(state) {}

    const SurfaceVoxels& voxels() const { return *chain_.graph().resource<SurfaceVoxels>("voxels"); }
    const HybridLeaves& leaves() const { return *chain_.graph().resource<HybridLeaves>("hybrid_leaves"); }
    Chain& chain() { return chain_; }

    std::vector<Hit> closest(HybridWalk walk, const std::vector<Ray>& rays) {
        HybridTracer tracer(walk);
        prepare(tracer, voxels(), compiler_);
        tracer.begin(stream_, scene_, voxels(), leaves());
        const std::vector<Hit> hits = closest(tracer, rays);
        counts = stream_.readAs<uint64_t>(tracer.counts(), 2);
        tests = stream_.readAs<uint64_t>(tracer.testCounts(), 1)[0];
        return hits;
    }
    std::vector<Hit> embree(const std::vector<Ray>& rays) {
        return closest(*makeRayTracer(TracerKind::Embree, device(), compiler_, *state_), rays);
    }

    std::vector<uint64_t> counts;  ///< Steps and visits of the last stream.
    uint64_t tests = 0;            ///< Of triangles.

 private:
    std::vector<Hit> closest(RayTracer& tracer, const std::vector<Ray>& rays) {
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray)),
            out(device(), "hits", rays.size() * sizeof(Hit));
        stream_.upload(in, rays);
        tracer.closestHit(stream_, in, out, uint32_t(rays.size()));
        return stream_.readAs<Hit>(out, rays.size());
    }

    Chain chain_;
    ShaderCompiler compiler_;
    CommandStream stream_;
    GpuScene scene_;
    std::shared_ptr<const SceneState> state_;
};

/// Rays from points in a scene's bounds, everywhere; every third begins beyond its origin or ends early.
std::vector<Ray> raysThrough(const Geometry& geometry, size_t count) {
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
double differing(const std::vector<Hit>& expected, const std::vector<Hit>& found) {
    size_t different = 0, hits = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        hits += expected[i].triangle != Hit::kMiss;
        if (expected[i].triangle == found[i].triangle) continue;
        // Of triangles at the same distance either may be met.
        if (expected[i].triangle == Hit::kMiss || found[i].triangle == Hit::kMiss ||
            std::abs(expected[i].t - found[i].t) > 1e-5f * (1 + expected[i].t))
            ++different;
    }
    EXPECT_GT(hits, found.size() / 4);
    return double(different) / double(found.size());
}

TEST(HybridLeaves, RaysMeetTheTrianglesThatEmbreeMeets) {
    for (const char* scene : {"cornell", "clutter", "spheres"}) {
        const std::shared_ptr<const SceneState> state = builtin(scene);
        Hybrid hybrid(state, 48, "primitives: 100000");
        const std::vector<Ray> rays = raysThrough(state->geometry, 100000);
        const std::vector<Hit> expected = hybrid.embree(rays);
        for (const HybridWalk walk : {HybridWalk::Hierarchical, HybridWalk::VoxelByVoxel}) {
            const double part = differing(expected, hybrid.closest(walk, rays));
            EXPECT_LE(part, 1e-4) << scene;
            std::printf("%s, walk %d: %.2g of the rays differ; a ray: %.3g steps, %.3g visits, %.3g tests\n",
                        scene, int(walk), part, double(hybrid.counts[0]) / double(rays.size()),
                        double(hybrid.counts[1]) / double(rays.size()),
                        double(hybrid.tests) / double(rays.size()));
        }
    }
}

TEST(HybridLeaves, ACapacityThatIsTooSmallIsRefused) {
    EXPECT_CONTAINS(errorOf([&] { Hybrid(builtin("clutter"), 8, "primitives: 1"); }), "raise 'primitives'");
    EXPECT_CONTAINS(errorOf([&] { Hybrid(builtin("clutter"), 8, "primitives: 0"); }), "primitives");
}

}  // namespace
}  // namespace voxray::test

// Walks of rays through voxels against a brute-force walk in doubles. Between two whole-numbered points that
// walk is exact: quotients of whole numbers below 2^25 differ by more than a double's rounding, or not at
// all.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtx/component_wise.hpp>
#include <limits>
#include <random>

#include "passes/common/compute/dispatch.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/prepared.h"
#include "tests/physics/made_up_voxels.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr int kUnits = 1 << 14;  // A voxel's, shaders/voxel_march/segment.glsl.
constexpr uint32_t kNoFace = 6;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// As in tests/gpu/voxel_march.comp.
struct Answer {
    glm::ivec3 start, end;
    uint32_t hit;
    glm::ivec3 voxel;
    uint32_t face;
    float t;
    uint32_t steps;
    bool operator==(const Answer&) const = default;
};

/// Made-up voxels, and rays through them by any walk.
class Voxels {
 public:
    Voxels(glm::uvec3 resolution, float voxelSize, const std::function<bool(glm::ivec3)>& occupied)
        : stream_(device()), compiler_(VOXRAY_SOURCE_DIR, VOXRAY_TEST_CACHE) {
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

    /// @param segments whether both ways of occlusion are asked for (in Answer::hit), instead of the closest
    /// voxel.
    std::vector<Answer> walk(VoxelWalk walk, const std::vector<Ray>& rays, float epsilon = 0,
                             bool segments = false) {
        VoxelMarch march(walk, epsilon);
        prepare(march, voxels_, compiler_);
        march.begin(stream_, voxels_);
        Defines defines = march.defines();
        if (segments) defines["SEGMENTS"] = "1";
        const Program program =
            makeComputeProgram(device(), compiler_.compile("tests/gpu/voxel_march.comp", defines));
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray));
        const Buffer out(device(), "answers", rays.size() * sizeof(Answer));
        stream_.upload(in, rays);
        std::vector<Binding> bindings = march.bindings();
        bindings.insert(bindings.end(), {{"rays", in}, {"answers", out}});
        const struct {
            gpu::VoxelGrid grid;
            uint32_t count;
        } push{grid, uint32_t(rays.size())};
        stream_.dispatch(program, bindings, push, linearGroups(rays.size()));
        counts = stream_.readAs<uint64_t>(march.counts(), 2);
        return stream_.readAs<Answer>(out, rays.size());
    }

    /// By a stream of rays.
    std::vector<Hit> closestHits(VoxelWalk walk, const std::vector<Ray>& rays) {
        VoxelTracer tracer(walk);
        prepare(tracer, voxels_, compiler_);
        tracer.begin(stream_, voxels_);
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray)),
            out(device(), "hits", rays.size() * sizeof(Hit));
        stream_.upload(in, rays);
        tracer.closestHit(stream_, in, out, uint32_t(rays.size()));
        return stream_.readAs<Hit>(out, rays.size());
    }

    gpu::VoxelGrid grid{};
    std::vector<uint64_t> counts;  ///< Steps and visits of the last walk.

 private:
    CommandStream stream_;
    ShaderCompiler compiler_;
    std::vector<bool> bits_;
    SurfaceVoxels voxels_;
};

struct Found {
    bool hit = false;
    glm::ivec3 voxel{-1};
    double part = 0;     ///< Of the segment, where the voxel begins.
    uint32_t steps = 0;  ///< Voxels before it.
};

/// The first occupied voxel between two points in units. Voxel by voxel: of the planes in front the one
/// reached first, upwards before downwards, several where they are reached at once.
Found bruteForce(const Voxels& voxels, glm::dvec3 start, glm::dvec3 end, double unit) {
    Found found;
    found.voxel = glm::ivec3(glm::floor(start / unit));
    const glm::dvec3 way = end - start;
    for (;; ++found.steps) {
        if (voxels.occupied(found.voxel)) {
            found.hit = true;
            return found;
        }
        std::pair<double, bool> first{2.0, false};
        std::array<std::pair<double, bool>, 3> reached;
        for (int axis = 0; axis < 3; ++axis) {
            const bool down = way[axis] < 0;
            const double plane = unit * (found.voxel[axis] + (down ? 0 : 1));
            const double part = std::abs(plane - start[axis]) / std::abs(way[axis]);
            const bool isWithin = way[axis] != 0 && (down ? part < 1 : part <= 1);
            reached[size_t(axis)] = {isWithin ? part : 3.0, down};
            first = std::min(first, reached[size_t(axis)]);
        }
        if (first.first > 1) return found;
        found.part = first.first;
        for (int axis = 0; axis < 3; ++axis)
            if (reached[size_t(axis)] == first) found.voxel[axis] += first.second ? -1 : 1;
    }
}

std::vector<Ray> randomRays(const gpu::VoxelGrid& grid, size_t count, uint32_t seed) {
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

/// Rays along axes, faces and edges, through corners, of no length, from and to planes between voxels, from
/// within, out of the grid and past it.
std::vector<Ray> adversarialRays(const gpu::VoxelGrid& grid, size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto any = [&](int smallest, int largest) {
        return std::uniform_int_distribution<int>(smallest, largest)(random);
    };
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        // In voxels: on corners, edges, faces or within, at times beyond the border or exactly on it.
        glm::vec3 from, way;
        for (int axis = 0; axis < 3; ++axis) {
            const int size = int(grid.resolution[axis]);
            from[axis] = float(any(-1, size + 1));
            if (any(0, 2) == 0) from[axis] += i % 5 == 0 ? 0.5f : uniform(random);
            if (any(0, 9) == 0) from[axis] = any(0, 1) ? 0.0f : float(size);
            way[axis] = float(any(-1, 1)) * (i % 4 == 0 ? float(any(1, 4)) : 1.0f);
            if (i % 7 == 0) way[axis] *= std::ldexp(1.0f, any(-30, 0));
        }
        if (any(0, 9) == 0) way = glm::vec3(0, -0.0f, 0);
        const float length = any(0, 3) == 0 ? kInfinity : float(any(0, int(grid.resolution.x)));
        rays[i] = {grid.origin + from * grid.voxelSize, 0, way * grid.voxelSize, length};
    }
    return rays;
}

/// Checks the walks' common answers against the brute-force walk along the segments that they walked.
void expectBruteForce(Voxels& voxels, const std::vector<Ray>& rays) {
    const std::vector<Answer> answers = voxels.walk(VoxelWalk::Bits, rays);
    uint64_t steps = 0, hits = 0, inGrid = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Answer& a = answers[i];
        if (a.start.x < 0) {
            ASSERT_EQ(a.hit, 0u) << i;
            continue;
        }
        ++inGrid;
        const Found found = bruteForce(voxels, glm::dvec3(a.start) + 0.5, glm::dvec3(a.end) + 0.5, kUnits);
        ASSERT_EQ(a.hit != 0, found.hit) << i;
        ASSERT_EQ(a.steps, found.steps) << i;
        steps += found.steps;
        if (!found.hit) continue;
        ++hits;
        ASSERT_EQ(a.voxel, found.voxel) << i;
        ASSERT_TRUE(std::isfinite(a.t)) << i;
        ASSERT_GE(a.t, rays[i].tMin) << i;
        ASSERT_LE(a.t, rays[i].tMax) << i;
        ASSERT_EQ(a.face == kNoFace, found.steps == 0) << i;
    }
    EXPECT_EQ(voxels.counts[0], steps) << "steps that were counted on the device";
    EXPECT_GT(hits, rays.size() / 100);
    EXPECT_GT(inGrid, hits);

    for (const VoxelWalk walk : {VoxelWalk::Bricks, VoxelWalk::OctreeRestart, VoxelWalk::Octree}) {
        const std::vector<Answer> others = voxels.walk(walk, rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            Answer expected = answers[i];
            ASSERT_LE(others[i].steps, expected.steps) << i;
            expected.steps = others[i].steps;
            ASSERT_EQ(others[i], expected) << i << " by walk " << int(walk);
        }
        EXPECT_LT(voxels.counts[0], steps);
    }
}

bool isSparse(glm::ivec3 v, uint32_t inThousand) {
    uint32_t hash = uint32_t(v.x) * 0x9e3779b1u ^ uint32_t(v.y) * 0x85ebca77u ^ uint32_t(v.z) * 0xc2b2ae3du;
    hash ^= hash >> 15, hash *= 0x2c1b3c6du, hash ^= hash >> 12, hash *= 0x297a2d39u, hash ^= hash >> 15;
    return hash % 1000 < inThousand;
}

/// Voxels here and there; a hollow sphere; and nearly nothing, in which steps are large.
Voxels sparseVoxels() {
    return Voxels({130, 37, 201}, 0.09f, [](glm::ivec3 v) { return isSparse(v, 8); });
}
Voxels sphereVoxels() {
    return Voxels(glm::uvec3(128), 0.125f, [](glm::ivec3 v) {
        return std::abs(glm::length(glm::dvec3(v) + 0.5 - 64.0) - 50) < 0.7 || v == glm::ivec3(64);
    });
}
/// As long as walks take, for what is rounded far from the origin.
Voxels longVoxels() {
    return Voxels({1024, 11, 18}, 0.02f, [](glm::ivec3 v) { return isSparse(v, 3); });
}
Voxels emptyVoxels() {
    return Voxels({250, 256, 64}, 0.02f,
                  [](glm::ivec3 v) { return isSparse(v / 16, 80) && isSparse(v, 60); });
}

TEST(VoxelMarch, FindsWhatABruteForceWalkFinds) {
    Voxels sparse = sparseVoxels(), sphere = sphereVoxels(), empty = emptyVoxels(), far = longVoxels();
    expectBruteForce(sparse, randomRays(sparse.grid, 300000, 1));
    expectBruteForce(far, randomRays(far.grid, 100000, 9));
    expectBruteForce(sphere, randomRays(sphere.grid, 300000, 2));
    expectBruteForce(empty, randomRays(empty.grid, 300000, 3));
}

TEST(VoxelMarch, FindsItAlongAxesFacesAndEdges) {
    Voxels sparse = sparseVoxels(), sphere = sphereVoxels(), empty = emptyVoxels(), far = longVoxels();
    for (Voxels* voxels : {&sparse, &sphere, &empty, &far})
        expectBruteForce(*voxels, adversarialRays(voxels->grid, 25000));
}

TEST(VoxelMarch, WalksAlongTheRayThatItIsGiven) {
    // The segments' ends against the ray cut at the grid's faces in doubles, within rounding of what is
    // computed in floats; where both find a voxel it begins at the same place.
    Voxels voxels = sparseVoxels();
    const std::vector<Ray> rays = randomRays(voxels.grid, 200000, 4);
    const std::vector<Answer> answers = voxels.walk(VoxelWalk::Octree, rays);
    const glm::dvec3 size(voxels.grid.resolution);
    size_t different = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 from =
            (glm::dvec3(rays[i].origin) - glm::dvec3(voxels.grid.origin)) / double(voxels.grid.voxelSize);
        const glm::dvec3 way = glm::dvec3(rays[i].direction) / double(voxels.grid.voxelSize);
        double begin = rays[i].tMin, end = rays[i].tMax;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = -from[axis] / way[axis], high = (size[axis] - from[axis]) / way[axis];
            begin = std::max(begin, std::min(low, high));
            end = std::min(end, std::max(low, high));
        }
        if (answers[i].start.x < 0) {
            ASSERT_LT((end - begin) * glm::length(way), 1e-3) << i;
            continue;
        }
        const double tolerance = 1.5 / kUnits + 5e-6 * glm::compMax(size);
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(answers[i].start[axis] / double(kUnits), from[axis] + begin * way[axis], tolerance)
                << i;
            ASSERT_NEAR(answers[i].end[axis] / double(kUnits), from[axis] + end * way[axis], tolerance) << i;
        }

        // Without rounding to units another voxel is met where the ray passes one's edge.
        const auto inside = [&](glm::dvec3 p) { return glm::clamp(p, glm::dvec3(0), size - 1e-9); };
        const Found found = bruteForce(voxels, inside(from + begin * way), inside(from + end * way), 1.0);
        if (found.hit != (answers[i].hit != 0) || (found.hit && found.voxel != answers[i].voxel)) {
            ++different;
            continue;
        }
        if (found.hit) {
            EXPECT_NEAR(answers[i].t, begin + found.part * (end - begin), 1e-4 * (1 + end)) << i;
        }
    }
    EXPECT_LT(double(different) / double(rays.size()), 2e-3);
    std::printf("units instead of doubles: %.2g of the answers differ\n",
                double(different) / double(rays.size()));
}

TEST(VoxelMarch, SeesTheSameFromBothEnds) {
    Voxels voxels = sparseVoxels();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<Ray> pairs(100000);
    const glm::vec3 extent = glm::vec3(voxels.grid.resolution) * voxels.grid.voxelSize;
    for (Ray& ray : pairs) {
        const auto point = [&] {
            return voxels.grid.origin + extent * glm::vec3(uniform(random), uniform(random), uniform(random));
        };
        ray.origin = point();
        ray.direction = 0.3f * (point() - ray.origin);
    }
    for (const VoxelWalk walk : {VoxelWalk::Bits, VoxelWalk::Bricks, VoxelWalk::Octree}) {
        size_t seen = 0;
        for (const Answer& answer : voxels.walk(walk, pairs, 0, true)) {
            ASSERT_TRUE(answer.hit == 0 || answer.hit == 3);
            seen += answer.hit == 0;
        }
        EXPECT_GT(seen, pairs.size() / 10);
        EXPECT_LT(seen, pairs.size() * 9 / 10);
    }
}

TEST(VoxelMarch, StepsByAnEpsilonSkipSlivers) {
    // Sun and Agu 2015, figure 3, line 20: the larger the epsilon, the more corners of voxels are missed.
    Voxels voxels = sparseVoxels();
    const std::vector<Ray> rays = randomRays(voxels.grid, 200000, 6);
    const std::vector<Answer> exact = voxels.walk(VoxelWalk::OctreeRestart, rays);
    double before = 0;
    for (const float epsilon : {1e-4f, 1e-3f, 1e-2f, 1e-1f}) {
        const std::vector<Answer> steps = voxels.walk(VoxelWalk::OctreeRestart, rays, epsilon);
        size_t occlusion = 0, closest = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            occlusion += steps[i].hit != exact[i].hit;
            closest += steps[i].voxel != exact[i].voxel && steps[i].hit == exact[i].hit;
        }
        const double fraction = double(occlusion + closest) / double(rays.size());
        std::printf(
            "epsilon %g voxels: occlusion differs for %.2g of the rays, the closest voxel alone for %.2g\n",
            double(epsilon), double(occlusion) / double(rays.size()), double(closest) / double(rays.size()));
        EXPECT_GE(fraction, before);
        EXPECT_LT(fraction, 0.01 + 2 * epsilon);
        before = fraction;
    }
    EXPECT_GT(before, 1e-3);
}

TEST(VoxelMarch, PassesAFullGridAndAnEmptyOne) {
    // A single voxel, all voxels and none but one in a far corner; rays without end from outside and within.
    for (const uint32_t resolution : {1u, 16u, 65u}) {
        for (const bool full : {true, false}) {
            Voxels voxels(glm::uvec3(resolution), 0.125f,
                          [&](glm::ivec3 v) { return full || v == glm::ivec3(int(resolution) - 1); });
            const std::vector<Ray> rays = randomRays(voxels.grid, 2000, 7);
            const std::vector<Answer> expected = voxels.walk(VoxelWalk::Bits, rays);
            for (const Answer& a : expected) ASSERT_TRUE(!full || (a.hit != 0) == (a.start.x >= 0));
            for (const VoxelWalk walk : {VoxelWalk::Bricks, VoxelWalk::OctreeRestart, VoxelWalk::Octree}) {
                const std::vector<Answer> answers = voxels.walk(walk, rays);
                for (size_t i = 0; i < rays.size(); ++i) {
                    ASSERT_EQ(answers[i].hit, expected[i].hit) << i;
                    ASSERT_EQ(answers[i].voxel, expected[i].voxel) << i;
                }
            }
        }
    }
}

TEST(VoxelMarch, StreamsHaveTheTracersInterface) {
    Voxels voxels = sphereVoxels();
    std::vector<Ray> rays = randomRays(voxels.grid, 20000, 8);
    const std::vector<Answer> expected = voxels.walk(VoxelWalk::Bits, rays);
    rays.push_back({glm::vec3(0), 0, glm::vec3(1), -1});         // Inactive.
    rays.push_back({glm::vec3(kInfinity), 0, glm::vec3(1), 1});  // Not finite.
    rays.push_back({glm::vec3(0), 0, glm::vec3(0, std::nanf(""), 1), 1});
    std::mt19937 random(1);
    for (const auto& [walk, name] : EnumNames<VoxelWalk>::names) {
        const std::vector<Hit> hits = voxels.closestHits(walk, rays);
        for (size_t i = 0; i < expected.size(); ++i) {
            ASSERT_EQ(hits[i].triangle != Hit::kMiss, expected[i].hit != 0) << name;
            ASSERT_EQ(hits[i].t, expected[i].hit ? expected[i].t : rays[i].tMax) << name;
        }
        for (size_t i = expected.size(); i < rays.size(); ++i)
            EXPECT_EQ(hits[i].triangle, Hit::kMiss) << name;
    }
}

TEST(VoxelMarch, RefusesGridsThatItCantWalkThrough) {
    VoxelMarch march(VoxelWalk::Bits);
    SurfaceVoxels window;
    window.grid = madeUpGrid(glm::uvec3(64), 1);
    window.grid.side = 32;
    MemoryPlan plan;
    EXPECT_CONTAINS(errorOf([&] { march.plan(plan, Geometry{}, window); }), "64x64x64, of which 32 are held");
}

TEST(VoxelMarch, ShadowsNarrowToThoseOfSurfaces) {
    // Direct light of a room with two blocks under a point light, by shadow rays through voxels and through
    // triangles: what differs are bands along shadows and edges, as wide as voxels. Pixels are smaller: else
    // a band shows or doesn't for a whole line of them.
    const auto chain = [](const std::string& visibility, int resolution) {
        return Chain("cornell", "{lights: point}",
                     fmt::format("[{{pass: gbuffer}}, {{pass: voxelize, resolution: {}}}, "
                                 "{{pass: direct_shadow_rays, visibility: {}}}]",
                                 resolution, visibility),
                     384, 384);
    };
    Chain exact = chain("exact", 16);
    const ImageF expected = exact.image("direct");
    EXPECT_EQ(exact.frameSamples.back().voxelSteps, 0u);
    double before = 0.1;
    for (const int resolution : {32, 64, 128, 256}) {
        Chain voxels = chain("voxels", resolution);
        const ImageF image = voxels.image("direct");
        double difference = 0;
        for (size_t i = 0; i < image.data.size(); ++i)
            difference += std::abs(double(image.data[i]) - double(expected.data[i]));
        difference /= mean(expected) * double(image.data.size());
        std::printf("%d voxels: energy %.4f of the exact, mean difference %.4f\n", resolution,
                    mean(image) / mean(expected), difference);
        EXPECT_LT(difference, 0.6 * before);
        EXPECT_LT(mean(image), 1.01 * mean(expected)) << "voxels enclose the surfaces";
        before = difference;

        const PassSample& sample = voxels.frameSamples.back();
        EXPECT_EQ(sample.rays, exact.frameSamples.back().rays);
        EXPECT_GT(sample.voxelSteps, sample.rays);
        EXPECT_GT(reported(sample, "voxel visits"), double(sample.voxelSteps));
    }
    EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace voxray::test

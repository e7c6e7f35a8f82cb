// The methods of voxelization next to each other: what each misses or adds, and what they agree on.
//
//     build/release/tests/tests_chain --gtest_filter='VoxelizeMethods.*'
//
// prints the table of docs/voxels.md.
#include <gtest/gtest.h>

#include <climits>
#include <filesystem>
#include <numbers>

#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"
#include "tests/support/places.h"

namespace voxray::test {
namespace {

constexpr const char* kMethods[] = {"exact", "dominant_axis", "msaa", "three_axis"};

struct Difference {
    int missed = 0, added = 0;
};

Difference compare(const Voxels& truth, const Voxels& other) {
    Difference d;
    truth.forEach([&](glm::ivec3 v) {
        d.missed += truth.occupied(v) && !other.occupied(v);
        d.added += !truth.occupied(v) && other.occupied(v);
    });
    return d;
}

/// Prints what the raster methods miss and add, in voxels, and their surface area. @return misses of
/// dominant_axis.
int report(const std::string& name, const std::shared_ptr<const Scene>& scene, int resolution) {
    const std::string common = ", visibility_rays: 0, resolution: " + std::to_string(resolution);
    const Voxels exact = voxelize(scene, "method: exact" + common);
    const Voxels dominant = voxelize(scene, "method: dominant_axis" + common);
    const Voxels three = voxelize(scene, "method: three_axis" + common);
    const Difference d = compare(exact, dominant), t = compare(exact, three);
    std::printf("| %s, %d³ | %u | %d | %d | %.3f | %d | %d | %.3f |\n", name.c_str(), resolution, exact.count, d.missed,
                d.added, dominant.area() / exact.area(), t.missed, t.added, three.area() / exact.area());
    return d.missed;
}

TEST(VoxelizeMethods, DominantAxisMissesNoVoxel) {
    std::printf("| scene | exact | dominant_axis misses | adds | area | three_axis misses | adds | area |\n");
    for (const std::string& name : builtinSceneNames())
        EXPECT_EQ(report(name, makeBuiltinScene(name, Value()), 64), 0) << name;
}

TEST(VoxelizeMethods, DominantAxisMissesNoVoxelOfSponza) {
    const std::filesystem::path file = test::scenesFolder() / "sponza.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "sponza.glb is not there";
    auto scene = std::make_shared<Scene>(*loadGltf(file));
    if (scene->cameras.empty()) scene->cameras.emplace_back();
    EXPECT_EQ(report("sponza", scene, 64), 0);
}

TEST(VoxelizeMethods, MultisamplingMissesWhatLiesBetweenSamples) {
    // Fewer voxels with more samples, and none that dominant_axis has not: both take all that a plane crosses
    const auto scene = makeBuiltinScene("furnace", Value());
    const std::string common = "resolution: 64, visibility_rays: 0, method: ";
    const Voxels dominant = voxelize(scene, common + "dominant_axis");
    int before = INT_MAX;
    for (const uint32_t samples : listSampleCounts(device().info())) {
        const Voxels voxels = voxelize(scene, common + "msaa, msaa_samples: " + std::to_string(samples));
        const Difference d = compare(dominant, voxels);
        std::printf("%u samples: of %u voxels %d missed, %d added, area %.4f\n", samples, dominant.count, d.missed,
                    d.added, voxels.area() / dominant.area());
        EXPECT_GT(d.missed, 0);
        EXPECT_LT(d.missed, before);
        EXPECT_EQ(d.added, 0);
        before = d.missed;
    }
    EXPECT_LT(before, int(dominant.count) / 20);
    EXPECT_CONTAINS(errorOf([&] { voxelize(scene, common + "msaa, msaa_samples: 64"); }), "msaa_samples 64");
}

TEST(VoxelizeMethods, HardwareConservativeMissesNoVoxelOrSaysWhatTheDeviceLacks) {
    for (const std::string& name : builtinSceneNames()) {
        const auto scene = makeBuiltinScene(name, Value());
        const std::string common = "resolution: 64, visibility_rays: 0, method: ";
        if (!device().info().conservativeRaster) {
            const std::string why = errorOf([&] { voxelize(scene, common + "hardware_conservative"); });
            EXPECT_CONTAINS(why, "VK_EXT_conservative_rasterization");
            EXPECT_CONTAINS(why, "method dominant_axis");
            continue;
        }
        const Difference d =
            compare(voxelize(scene, common + "exact"), voxelize(scene, common + "hardware_conservative"));
        std::printf("%s: %d missed, %d added\n", name.c_str(), d.missed, d.added);
        EXPECT_EQ(d.missed, 0) << name;
    }
}

/// Half a cylinder over 0 ≤ z ≤ 1 with its axis along z: an arch of thin triangles.
std::shared_ptr<const Scene> arch() {
    std::vector<glm::vec3> corners;
    constexpr int kSteps = 48;
    const auto rim = [](int i, float z) {
        const float angle = float(i) / kSteps * std::numbers::pi_v<float>;
        return glm::vec3(std::cos(angle), std::sin(angle), z);
    };
    for (int i = 0; i < kSteps; ++i) {
        const glm::vec3 a = rim(i, 0), b = rim(i + 1, 0), c = rim(i + 1, 0.3f), d = rim(i, 0.3f);
        corners.insert(corners.end(), {a, b, c, a, c, d});
    }
    return triangleScene(corners);
}

/// Fraction of points spread over all triangles that lie in empty voxels.
double missedPoints(const std::shared_ptr<const Scene>& scene, const std::string& parameters) {
    const Voxels voxels = voxelize(scene, parameters + ", visibility_rays: 0");
    const Geometry g = evaluate(scene, 0.0).geometry;
    int points = 0, missed = 0;
    for (const glm::uvec3 t : g.triangles)
        for (int i = 0; i <= 60; ++i)
            for (int j = 0; i + j <= 60; ++j, ++points) {
                const float u = float(i) / 60, v = float(j) / 60;
                const glm::vec3 p = g.positions[t.x] * (1 - u - v) + g.positions[t.y] * u + g.positions[t.z] * v;
                missed += !voxels.holds(p);
            }
    return double(missed) / points;
}

TEST(VoxelizeMethods, NoPointOfAnArchIsInAnEmptyVoxel) {
    // Where three projections sample the surface only at pixels' centers, voxels that it cuts near a corner
    // stay empty. Magalhães 2020 (section 5.1.3) filtered across them and saw streaks.
    EXPECT_GT(missedPoints(arch(), "method: three_axis, samples_per_voxel_edge: 1, resolution: 40"), 0.005);
    EXPECT_EQ(missedPoints(arch(), "method: dominant_axis, resolution: 40"), 0.0);
    EXPECT_EQ(missedPoints(arch(), "method: exact, resolution: 40"), 0.0);
    const auto cornell = makeBuiltinScene("cornell", Value());
    EXPECT_EQ(missedPoints(cornell, "method: dominant_axis, resolution: 64"), 0.0);
    EXPECT_EQ(missedPoints(cornell, "method: exact, resolution: 64"), 0.0);
}

TEST(VoxelizeMethods, LookupsMixInNoEmptyVoxels) {
    // Inside a glowing sphere the irradiance is the same everywhere. A lookup that filtered across voxels
    // without data would darken where the surface cuts voxels' corners.
    for (const std::string method : kMethods) {
        Chain chain("furnace", "{shape: sphere, albedo: 0.5, emission: 1}",
                    graphYaml({"gbuffer", "voxelize, resolution: 10, method: " + method,
                               "inject_light_rays, rays_per_light: 131072, bounces: 0",
                               "gather_irradiance, id: direct, light: direct", "gather_irradiance", "composite"}));
        const ImageF direct = chain.image("direct");
        const double expected = mean(direct);
        EXPECT_NEAR(expected, 0.5, 0.015) << method;
        double worst = 0;
        for (size_t i = 0; i < direct.data.size(); ++i)
            if (i % direct.channels < 3) worst = std::max(worst, std::abs(direct.data[i] / expected - 1));
        EXPECT_LT(worst, 0.3) << method;
    }
}

TEST(VoxelizeMethods, SumToTheSurfaceArea) {
    // A sphere has every orientation.
    const auto scene = makeBuiltinScene("furnace", Value());
    const double area = surfaceArea(evaluate(scene, 0.0).geometry);
    for (const auto& [method, tolerance] : {std::pair{"exact", 1e-4}, std::pair{"dominant_axis", 5e-3},
                                            std::pair{"msaa", 5e-3}, std::pair{"three_axis", 5e-3}}) {
        const Voxels v = voxelize(scene, std::string("resolution: 32, visibility_rays: 0, method: ") + method);
        EXPECT_NEAR(v.area() * v.grid.voxelSize * v.grid.voxelSize / area, 1.0, tolerance) << method;
    }
}

TEST(VoxelizeMethods, AcceptAGridOfOneVoxelAndTrianglesWithoutArea) {
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},     // a triangle,
                                         {0, 0, 0}, {0, 0, 1}, {0, 0, 0.5f},  // a line
                                         {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};    // and a point.
    for (const std::string method : kMethods) {
        const Voxels one = voxelize(triangleScene(corners), "resolution: 1, method: " + method);
        ASSERT_EQ(one.count, 1u) << method;
        // A sample of four is a quarter of the voxel's face
        const double tolerance = method == "exact" ? 1e-4 : method == "msaa" ? 0.4 : 0.2;
        EXPECT_NEAR(one.area() * one.grid.voxelSize * one.grid.voxelSize, 0.5, tolerance);
        const Voxels fine = voxelize(triangleScene(corners), "resolution: 16, method: " + method);
        EXPECT_FALSE(fine.holds({0, 0, 0.9f})) << method;
        EXPECT_TRUE(fine.holds({0.3f, 0.3f, 0})) << method;
    }
}

TEST(VoxelizeMethods, RefuseGridsBeyondMemoryBeforeAllocation) {
    const uint64_t limit = device().memoryLimitBytes();
    device().setMemoryLimitBytes(16u << 20);
    for (const std::string method : kMethods) {
        const auto make = [&] {
            voxelize(makeBuiltinScene("cornell", Value()), "resolution: 1024, method: " + method);
        };
        EXPECT_CONTAINS(errorOf(make), "voxelize") << method;
    }
    device().setMemoryLimitBytes(limit);
}

TEST(VoxelizeMethods, OneDirectionLetsLightThroughThinWalls) {
    // A room without light behind a wall of 2 cm, at voxels of 13 cm: one value a voxel mixes both sides.
    const auto leak = [](int directions) {
        Chain chain("thin_wall", "{thickness: 0.02}",
                    graphYaml({"gbuffer", "voxelize, directions: " + std::to_string(directions),
                               "inject_light_rays, rays_per_light: 262144, bounces: 2",
                               "gather_irradiance, id: direct, light: direct", "gather_irradiance", "composite"}));
        Chain bright("thin_wall", "{thickness: 0.02, view: lit}", graphYaml({"path_trace, spp: 64, bounces: 2"}));
        return mean(chain.image("final")) / mean(bright.image("final"));
    };
    const double six = leak(6), one = leak(1);
    std::printf("light in the dark room over light in the bright one: directions 6: %.5f, directions 1: %.5f\n", six,
                one);
    EXPECT_LT(six, 0.002);
    EXPECT_GT(one, 0.02);
}

}  // namespace
}  // namespace voxray::test

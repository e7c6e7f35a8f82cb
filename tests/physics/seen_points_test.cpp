// Which voxels light is gathered for, by points around them that the camera sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "passes/clusters/voxel_clusters.h"
#include "passes/common/view/gbuffer.h"
#include "scene/shapes.h"
#include "tests/physics/cluster_graph.h"

namespace voxray::test {
namespace {

std::string seenGraph(const std::string& update, const std::string& resolution) {
    return graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: " + resolution, "place_surfels",
                      "cluster_voxels, target: 1000", "find_patches", "cluster_visibility, rays: 16",
                      "inject_clusters, direct: shadow_rays", "gather_clusters, filter_passes: 0, update: " + update,
                      "gather_irradiance"});
}

/// By voxel: whether light was gathered for it.
std::vector<bool> gathered(Chain& chain) {
    const std::vector<float> areas = readAreas(chain, irradiance(chain).area);
    std::vector<bool> isGathered(areas.size() / 6);
    for (size_t i = 0; i < areas.size(); ++i)
        if (areas[i] > 0) isGathered[i / 6] = true;
    return isGathered;
}

TEST(SeenPoints, LeaveOutWhatIsBehindAWallAndBehindTheCamera) {
    // A floor of 10 m, a wall 4 m high across it at x = 0.3, and a camera 1 m above the floor at x = -3 that
    // looks at the wall. Points reach 2 / sqrt(2) voxels out of a voxel's center along an axis.
    SceneBuilder b("wall");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("floor", {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, grey);
    b.quad("wall", {0.3f, 0, -5}, {0, 4, 0}, {0, 0, 10}, grey);
    b.directionalLight({0, -1, 0}, glm::vec3(1));
    const glm::vec3 eye(-3, 1, 0);
    b.camera(eye, {0, 1, 0}, 60);
    Chain chain(evaluated(b), seenGraph("seen_points", "32"), 24, 24);
    const std::vector<bool> isGathered = gathered(chain);
    const auto coordinates = chain.read<glm::uvec3>(chain.get<VoxelClusters>("clusters").coordinates);
    const gpu::VoxelGrid grid = chain.get<SurfaceVoxels>("voxels").grid;
    const float voxel = grid.voxelSize, tangent = std::tan(glm::radians(30.0f));
    uint32_t before = 0, behindWall = 0, behindCamera = 0, beyondEdge = 0;
    for (size_t i = 0; i < isGathered.size(); ++i) {
        const glm::vec3 center = grid.origin + voxel * (glm::vec3(coordinates[i]) + 0.5f), fromEye = center - eye;
        const float reach = 2 * voxel;
        const float aside = std::max(std::abs(fromEye.y), std::abs(fromEye.z));
        if (center.x > 0.3f + 1.5f * voxel) {
            EXPECT_FALSE(isGathered[i]) << "behind the wall at " << center.x << " " << center.y << " " << center.z;
            ++behindWall;
        } else if (fromEye.x < -reach) {
            EXPECT_FALSE(isGathered[i]) << "behind the camera at " << center.x << " " << center.z;
            ++behindCamera;
        } else if (aside - reach > tangent * (fromEye.x + reach)) {
            EXPECT_FALSE(isGathered[i]) << "beyond the image's edge at " << center.x << " " << center.y << " "
                                        << center.z;
            ++beyondEdge;
        } else if (aside < tangent * fromEye.x) {
            EXPECT_TRUE(isGathered[i]) << "before the wall at " << center.x << " " << center.y << " " << center.z;
            ++before;
        }
    }
    std::printf("%u before, %u behind the wall, %u behind the camera, %u beyond the image's edge\n", before, behindWall,
                behindCamera, beyondEdge);
    EXPECT_GT(before, 100u);
    EXPECT_GT(behindWall, 300u);
    EXPECT_GT(behindCamera, 100u);
    EXPECT_GT(beyondEdge, 100u);
}

TEST(SeenPoints, KeepWhatWasSeen) {
    // From another place more comes into view, back again nothing, and all again where light has changed.
    Chain chain("cornell", "{lights: point}", seenGraph("seen_points", "24"), 24, 24);
    const auto found = [&] { return reported(chain.frameSamples.at(1), "voxels gathered"); };
    const double first = found();
    const glm::vec3 from = chain.state().cameras.at(0).position;
    chain.runFrameFrom(from + glm::vec3(0.3f, 0.2f, -1.5f));
    EXPECT_GT(found(), 0);
    EXPECT_LT(found(), first);
    chain.runFrameFrom(from);
    EXPECT_EQ(found(), 0);
    chain.update(moveLight);
    EXPECT_EQ(found(), first);
}

/// What the test by points leaves out of what trilinear lookups read, next to that by lookups.
struct LeftOut {
    double voxels, byLookup, byPoints;  ///< Of the scene, and those that light is gathered for.
    double read, missed;                ///< Voxels with light that lookups read; those left out by points.
    double holes;                       ///< Pixels that are black by points alone, of all that have light.
    double nrmse;                       ///< Of the image against that by lookups.
};

LeftOut leftOut(const State& state, uint32_t width, uint32_t height) {
    Chain lookup(state, seenGraph("seen", "64"), width, height);
    Chain points(state, seenGraph("seen_points", "64"), width, height);
    const std::vector<bool> byLookup = gathered(lookup), byPoints = gathered(points);
    const auto count = [](const std::vector<bool>& flags) { return double(std::ranges::count(flags, true)); };
    LeftOut r{double(byLookup.size()), count(byLookup), count(byPoints), 0, 0, 0, 0};

    // The eight voxels round each texel
    const Voxels voxels(lookup);
    const auto coordinates = lookup.read<glm::uvec3>(lookup.get<VoxelClusters>("clusters").coordinates);
    const auto positions = lookup.readImage<glm::vec4>(lookup.get<GBuffer>("gbuffer").position);
    std::vector<bool> isRead(byLookup.size());
    for (const glm::vec4& p : positions) {
        if (p.w == 0) continue;
        const glm::vec3 corner = glm::floor((glm::vec3(p) - voxels.grid.origin) / voxels.grid.voxelSize - 0.5f);
        for (int i = 0; i < 8; ++i) {
            const glm::ivec3 v = glm::ivec3(corner) + glm::ivec3(i & 1, i >> 1 & 1, i >> 2);
            if (glm::any(glm::lessThan(v, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(v, glm::ivec3(voxels.grid.resolution))) || !voxels.occupied(v))
                continue;
            isRead[voxels.number(v)] = true;
        }
    }
    for (size_t i = 0; i < isRead.size(); ++i) {
        if (!isRead[i] || !byLookup[i]) continue;
        r.read += 1;
        r.missed += byPoints[i] ? 0 : 1;
    }

    const ImageF right = lookup.image("indirect"), got = points.image("indirect");
    double lit = 0, squares = 0, difference = 0;
    for (size_t i = 1; i < right.data.size(); i += 3) {
        lit += right.data[i] > 0 ? 1 : 0;
        r.holes += right.data[i] > 0 && got.data[i] == 0 ? 1 : 0;
        squares += double(right.data[i]) * right.data[i];
        difference += std::pow(double(got.data[i]) - right.data[i], 2);
    }
    r.holes /= lit;
    r.nrmse = std::sqrt(difference / squares);
    std::printf(
        "%.0f voxels, %.0f by lookup, %.0f by points; lookups read %.0f, of which points miss %.4f; "
        "%.4f of the pixels are holes; nRMSE %.4f\n",
        r.voxels, r.byLookup, r.byPoints, r.read, r.missed / r.read, r.holes, r.nrmse);
    return r;
}

TEST(SeenPoints, MissLittleOfCornell) {
    const auto state = builtin("cornell", "{lights: point}");
    const LeftOut r = leftOut(state, 64, 64);
    EXPECT_LT(r.byPoints, r.voxels);
    EXPECT_LT(r.missed, 0.05 * r.read);
    EXPECT_EQ(r.holes, 0);
}

TEST(SeenPoints, MissLittleOfSponza) {
    const std::filesystem::path file = test::scenesFolder() / "sponza.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "sponza.glb is not there";
    SceneBuilder b("view");
    b.camera({-9, 1.2f, -0.3f}, {0, 3, 0}, 60);
    b.directionalLight(glm::normalize(glm::vec3(-0.12f, -1, -0.08f)), glm::vec3(10));
    const auto view = evaluate(b.finish(), 0.0);
    const auto state = evaluated(loadGltf(file));
    state->cameras = view.cameras;
    state->lights = view.lights;
    const LeftOut r = leftOut(state, 96, 54);
    EXPECT_LT(r.byPoints, r.voxels);
    EXPECT_LT(r.missed, 0.1 * r.read);
    EXPECT_LT(r.holes, 0.01);
}

}  // namespace
}  // namespace voxray::test

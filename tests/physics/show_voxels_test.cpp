#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/physics/cluster_graph.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::test;

namespace {

constexpr uint32_t kSize = 32;
constexpr const char* kEmptyBox = "{lights: point, boxes: false}";

/// By patch: whether light arrives straight from the lights, as passes/surfels/radiosity.glsl packs it.
std::vector<bool> litPatches(Chain& chain) {
    std::vector<bool> is;
    for (const uint32_t bits : chain.read<uint32_t>(chain.get<ClusterLight>("cluster_light").direct))
        is.push_back((bits & 0xffffffu) != 0);
    return is;
}

glm::vec3 pixelOf(const ImageF& image, uint32_t x, uint32_t y) {
    const float* p = &image.data[3 * (size_t(y) * image.width + x)];
    return {p[0], p[1], p[2]};
}

}  // namespace

TEST(ShowVoxels, DrawsWhatTheVoxelsOfAWallHold) {
    const glm::vec3 grey(0.73f), red(0.63f, 0.065f, 0.05f);
    Chain albedo("cornell", kEmptyBox, graphYaml({"voxelize", "show_voxels"}), kSize, kSize);
    const ImageF image = albedo.image("final");
    EXPECT_LT(glm::distance(pixelOf(image, kSize / 2, kSize / 2), grey), 1e-3f) << "the back wall";
    EXPECT_LT(glm::distance(pixelOf(image, 3, kSize / 2), red), 1e-2f) << "the left wall";
    EXPECT_GT(albedo.frameSamples[0].voxelSteps, 0u);

    // The back wall looks towards +z and fills its voxels
    const auto center = [](const char* show) {
        Chain chain("cornell", kEmptyBox, graphYaml({"voxelize", std::string("show_voxels, show: ") + show}), kSize,
                    kSize);
        return pixelOf(chain.image("final"), kSize / 2, kSize / 2);
    };
    EXPECT_LT(glm::distance(center("normal"), glm::vec3(0.5f, 0.5f, 1.0f)), 1e-3f);
    EXPECT_EQ(center("opacity"), glm::vec3(1.0f));
}

TEST(ShowVoxels, DrawsTheIrradianceOfTheFaceThatIsSeen) {
    Chain chain("cornell", kEmptyBox,
                graphYaml({"voxelize", "inject_light_rays, rays_per_light: 1048576, bounces: 0",
                           "show_voxels, show: irradiance"}),
                kSize, kSize);
    const ImageF image = chain.image("final");
    const Camera& camera = chain.state().cameras.at(0);
    const Light& light = chain.state().lights.at(0);

    // The center of the back wall, z = -1: intensity times cosine over squared distance, over pi
    const float halfHeight = std::tan(camera.verticalFovRadians / 2);
    double shown = 0, right = 0;
    for (uint32_t y = 10; y < 22; ++y)
        for (uint32_t x = 10; x < 22; ++x) {
            const float u = 2 * (float(x) + 0.5f) / kSize - 1, v = 2 * (float(y) + 0.5f) / kSize - 1;
            const glm::vec3 direction(u * halfHeight, -v * halfHeight, -1);
            const glm::vec3 at = camera.position + (camera.position.z + 1) * direction;
            const glm::vec3 toLight = light.position - at;
            const float distance = glm::length(toLight);
            shown += double(pixelOf(image, x, y).x);
            right += double(light.intensity.x * toLight.z / (distance * distance * distance) / 3.14159265f);
        }
    // 144 pixels see some 500 voxels' faces with about 30,000 rays: 0.6 % of noise
    RecordProperty("ratio", std::to_string(shown / right));
    EXPECT_NEAR(shown / right, 1, 0.03);
}

TEST(ShowVoxels, DrawsEachLevelOfPrefilteredVoxels) {
    for (const char* layout : {"dense", "svo"}) {
        const auto shown = [&](const std::string& parameters) {
            return Chain("cornell", kEmptyBox,
                         graphYaml({"voxelize, resolution: 32", "inject_light_rays, rays_per_light: 262144, bounces: 0",
                                    std::string("filter_voxels, layout: ") + layout, "show_voxels, " + parameters}),
                         kSize, kSize)
                .image("final");
        };
        // The wall fills its voxels, and one layer of larger voxels hides as much
        double atLevel[2] = {};
        for (const uint32_t level : {0u, 1u}) {
            const std::string levelText = ", level: " + std::to_string(level);
            EXPECT_NEAR(pixelOf(shown("show: radiance_opacity" + levelText), 16, 16).x, 1, 1e-3) << layout << level;
            const ImageF image = shown("show: radiance" + levelText);
            for (uint32_t y = 10; y < 22; ++y)
                for (uint32_t x = 10; x < 22; ++x) atLevel[level] += double(pixelOf(image, x, y).x) / 144;
        }
        // The same light at all scales: what larger voxels average changes by 3 % over their width
        EXPECT_GT(atLevel[0], 0);
        EXPECT_NEAR(atLevel[1] / atLevel[0], 1, 0.03) << layout;
    }
    EXPECT_ERROR("0 to 5", Chain("cornell", kEmptyBox,
                                 graphYaml({"voxelize, resolution: 32", "inject_light_rays", "filter_voxels",
                                            "show_voxels, show: radiance, level: 9"})));
}

TEST(ShowVoxels, CountsTheLitFacesOfARoomThatAFaceSees) {
    // A lamp lights all walls of a closed room of 8 voxels. All voxels are one cluster: each face sees all of
    // its component's that look another way, 5 times 8², but for those in a corner that no surfel fell on.
    Chain chain("white_room", "{}",
                graphYaml({"voxelize, resolution: 8", "place_surfels", "cluster_voxels, target: 1, unassigned: nearest",
                           "find_patches", "cluster_visibility, rays: 256, near_distance: 0",
                           "inject_clusters, direct: shadow_rays", "show_voxels, show: lit_faces, red_at: 640"}),
                kSize, kSize);
    chain.runFrameFrom({});  // From the center: the camera's own place is in a wall's voxels.
    const auto faces = facesOfPatches(readGroups(chain));
    const std::vector<bool> isLit = litPatches(chain);
    uint32_t lit = 0, back = 0;
    for (size_t i = 0; i < faces.size(); ++i) {
        lit += isLit[i] ? 1 : 0;
        back += isLit[i] && faces[i] % 6 == 4 ? 1 : 0;
    }
    EXPECT_LE(lit, 6 * 64u);
    EXPECT_GE(lit, 6 * 64u - 4);

    // 80° wide, from 1 m before it: the back wall fills the image.
    const ImageF image = chain.image("final");
    const float red = float(lit - back) / 640;
    for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x)
            EXPECT_LT(glm::distance(pixelOf(image, x, y), glm::vec3(red, 1 - red, 0)), 1e-6f) << x << " " << y;
}

TEST(ShowVoxels, CountsLitFacesAsListsTell) {
    // A spot lights a part of the floor: what faces of the back wall see of it, near by voxels and far by
    // clusters, out of the lists themselves.
    constexpr uint32_t kRed = 1000;
    Chain chain("cornell", "{lights: spot, boxes: false}",
                graphYaml({"voxelize, resolution: 16", "place_surfels", "cluster_voxels, target: 100", "find_patches",
                           "cluster_visibility, rays: 64", "inject_clusters, direct: shadow_rays",
                           "show_voxels, show: lit_faces, red_at: " + std::to_string(kRed)}),
                kSize, kSize);
    const auto& patches = chain.get<VoxelPatches>("patches");
    const auto groups = readGroups(chain);
    const auto components = chain.read<gpu::ClusterComponent>(patches.components);
    const auto memberGroups = chain.read<uint32_t>(patches.memberGroups);
    const auto firstGroup = chain.read<uint32_t>(patches.firstGroup);
    const std::vector<bool> isLit = litPatches(chain);
    const auto faces = facesOfPatches(groups);
    const auto lists = readVisibilityLists(chain);
    const auto targets = facesOfComponents(chain);
    std::vector<uint32_t> litOfComponents(targets.size());
    for (size_t target = 0; target < targets.size(); ++target) {
        const uint32_t component = targets[target] / 6;
        for (uint32_t k = components[component].firstMember; k < components[component + 1].firstMember; ++k)
            for (uint32_t p = groups[memberGroups[k]].firstPatch; p < groups[memberGroups[k] + 1].firstPatch; ++p)
                if (faces[p] % 6 == targets[target] % 6) litOfComponents[target] += isLit[p] ? 1 : 0;
    }

    const Voxels voxels(chain);
    const Camera& camera = chain.state().cameras.at(0);
    const float halfHeight = std::tan(camera.verticalFovRadians / 2), size = voxels.grid.voxelSize;
    const int wall = int(std::floor((-1 - voxels.grid.origin.z) / size));
    const float front = voxels.grid.origin.z + size * float(wall + 1);
    const ImageF image = chain.image("final");
    uint32_t most = 0, none = 0;
    for (uint32_t y = 10; y < 22; ++y)
        for (uint32_t x = 10; x < 22; ++x) {
            const float u = 2 * (float(x) + 0.5f) / kSize - 1, v = 2 * (float(y) + 0.5f) / kSize - 1;
            const glm::vec3 at =
                camera.position + (camera.position.z - front) * glm::vec3(u * halfHeight, -v * halfHeight, -1);
            glm::ivec3 voxel = glm::ivec3(glm::floor((at - voxels.grid.origin) / size));
            voxel.z = wall;
            const uint32_t number = voxels.number(voxel);
            uint32_t seen = 0;
            for (uint32_t patch = 0; patch < faces.size(); ++patch) {
                const uint32_t group = faces[patch] / 6;
                if (faces[patch] % 6 != 4 || group < firstGroup[number] || group >= firstGroup[number + 1]) continue;
                for (const VisibilityEntry& entry : lists[patch])
                    seen += entry.target < litOfComponents.size()
                                ? litOfComponents[entry.target]
                                : uint32_t(isLit[entry.target - litOfComponents.size()]);
            }
            const float red = float(seen) / kRed;
            EXPECT_LT(glm::distance(pixelOf(image, x, y), glm::vec3(red, 1 - red, 0)), 1e-5f) << x << " " << y;
            most = std::max(most, seen);
            none += seen == 0 ? 1 : 0;
        }
    std::printf("at most %u lit faces, %u pixels of 144 see none\n", most, none);
    EXPECT_GT(most, 10u);
    EXPECT_LT(most, kRed);
}

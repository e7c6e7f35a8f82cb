// Radiance voxels: what surfaces send and how much of a beam they cover, at all scales, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gpu/radiance_samples.h"

namespace voxray::test {
namespace {

std::string filterGraph(const std::string& voxelize, const std::string& filter = "emission: false") {
    return graphYaml({"voxelize, " + voxelize, "inject_light_rays, bounces: 0", "filter_voxels, " + filter});
}

/// Coverages that a ray collects from `from` on, in steps of half a footprint.
double coverageAlong(const Chain& chain, glm::vec3 from, glm::vec3 direction, double length, float footprint) {
    std::vector<RadianceQuery> queries;
    for (float t = 0; t < length; t += 0.5f * footprint)
        queries.push_back({from + t * direction, footprint, direction});
    double sum = 0;
    for (const glm::vec4 met : sampleRadiance(chain, queries)) sum += 0.5 * met.a;
    return sum;
}

TEST(RadianceVoxels, AWallCoversARayOnceAtEveryScaleAndAngle) {
    // The walls of a room of 2 m, at a resolution that no power of two divides.
    const Chain chain("white_room", "{}", filterGraph("resolution: 48"));
    const float voxel = radiance(chain).grid.voxelSize;
    for (const glm::vec3 towards : {glm::vec3(1, 0, 0), glm::vec3(0.8f, 0.36f, 0.48f), glm::vec3(0.3f, 0, -0.9f)})
        for (const float footprint : {voxel, 1.5f * voxel, 2 * voxel, 5 * voxel})
            EXPECT_NEAR(coverageAlong(chain, {0, 0, 0}, glm::normalize(towards), 3.0, footprint), 1.0, 0.05)
                << towards.x << ' ' << towards.y << ' ' << towards.z << ", footprint " << footprint / voxel;
}

TEST(RadianceVoxels, SendWhatTheirSurfacesReflect) {
    // Furnace without reflection: emission 3 alone; seen from within, and dark from outside.
    const Chain chain("furnace", "{shape: box, albedo: 0, emission: 3}",
                      filterGraph("resolution: 32", "emission: true"));
    const float voxel = radiance(chain).grid.voxelSize;
    for (const float footprint : {voxel, 3 * voxel, 8 * voxel}) {
        const std::vector<glm::vec4> met =
            sampleRadiance(chain, {{{0.99f, 0, 0}, footprint, {1, 0, 0}}, {{0.99f, 0, 0}, footprint, {-1, 0, 0}}});
        EXPECT_GT(met[0].a, 0.3) << footprint;
        EXPECT_NEAR(met[0].y / met[0].a, 3.0, 0.01) << footprint;
        EXPECT_EQ(met[1].y, 0.0f) << footprint;
    }
}

TEST(RadianceVoxels, OneDirectionMixesTheSides) {
    const Chain chain("furnace", "{shape: box, albedo: 0, emission: 3}",
                      filterGraph("resolution: 32, directions: 1", "emission: true"));
    const std::vector<glm::vec4> met =
        sampleRadiance(chain, {{{0.99f, 0, 0}, radiance(chain).grid.voxelSize, {-1, 0, 0}}});
    EXPECT_NEAR(met[0].y / met[0].a, 1.5, 0.01);
}

TEST(RadianceVoxels, MemoryIsPredicted) {
    const Chain chain("cornell", "{lights: point}", filterGraph("resolution: 32"));
    const RadianceVoxels& r = radiance(chain);
    EXPECT_EQ(chain.planned.back().bytes, r.header.bytes() + r.storage[0].bytes());
}

TEST(RadianceVoxels, AreFilteredInThePhaseOfTheirLight) {
    const auto phaseWith = [](const std::string& inject) {
        const Chain chain("cornell", "{lights: point}",
                          graphYaml({"voxelize, resolution: 8", inject, "filter_voxels"}));
        return chain.graph().passes().back().phase;
    };
    EXPECT_EQ(phaseWith("inject_camera_rays, rays_per_image: 64"), Phase::Frame);
    EXPECT_EQ(phaseWith("inject_light_rays, rays_per_light: 64"), Phase::Build);
}

}  // namespace
}  // namespace voxray::test

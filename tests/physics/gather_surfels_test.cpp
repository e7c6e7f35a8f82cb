// Lookups of surfels, against a sum over all surfels on the host.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/sorted_surfels.h"
#include "passes/surfels/surfels_by_voxel.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

// A surfel with its light as lookups read it (LitSurfels of passes/surfels/packed_surfel.glsl).
struct Lit {
    uint32_t position, radiosity;
    uint32_t normal, normalAndDistance;
};

// In voxels from the corner of the surfel's voxel.
glm::vec3 inVoxel(const Lit& s) {
    const glm::vec3 steps(s.position & 1023u, s.position >> 10 & 1023u, s.position >> 20 & 1023u);
    return (steps + 0.5f) * 3.0f / 1024.0f - 1.0f;
}

glm::vec3 normalOf(const Lit& s) {
    const auto coordinate = [](uint32_t bits) { return float(int16_t(bits & 0xffffu)) / 32767; };
    return {coordinate(s.normal), coordinate(s.normal >> 16), coordinate(s.normalAndDistance)};
}

glm::vec3 radiosity(uint32_t bits) {
    const glm::vec3 mantissas(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u);
    return mantissas * std::ldexp(1.0f, int(bits >> 24) - 128) / 255.0f;
}

// The weight of a surfel at a point (docs/surfels.md), without that of its voxel. @param offset in voxels.
float weightOf(glm::vec3 offset, glm::vec3 normal, glm::vec3 surfelNormal, float inverseDistance, float noise) {
    const float cosine = glm::dot(normal, surfelNormal), squared = glm::dot(offset, offset);
    if (cosine <= 0) return 0;
    const float height = std::max(std::abs(glm::dot(normal, offset)), std::abs(glm::dot(surfelNormal, offset)));
    const float plane = squared > 0 ? 2 * std::min(height * height / squared, 1.0f) : 0;
    return noise / (noise + plane + (1 - cosine) / cosine + squared * inverseDistance * inverseDistance);
}

class GatherSurfelsTest : public testing::TestWithParam<int> {};

TEST_P(GatherSurfelsTest, TakesTheMeanOfAllSurfelsInTheVoxelsAround) {
    // The room's walls have surfels on both sides, and corners of three directions in a voxel. With 40 points a voxel
    // has more surfels than a word has bits.
    Chain chain(builtin("cornell", "{lights: point}"),
                graphYaml({"gbuffer", "voxelize, resolution: 12",
                           "place_surfels, points_per_voxel: " + std::to_string(GetParam()),
                           "link_surfels, rays_per_surfel: 8", "inject_radiosity, bounces: 2", "gather_surfels"}),
                32, 32);
    const gpu::VoxelGrid grid = chain.get<SurfaceVoxels>("voxels").grid;
    const auto& light = chain.get<SurfelIrradiance>("surfel_irradiance");
    const auto sorted = chain.read<gpu::SortedSurfel>(chain.get<SurfelsByVoxel>("surfels_by_voxel").sorted);
    const auto lit = chain.read<Lit>(light.lit);
    ASSERT_EQ(lit.size(), sorted.size());
    const auto& gbuffer = chain.get<GBuffer>("gbuffer");
    const auto positions = chain.readImage<glm::vec4>(gbuffer.position);
    const auto normals = chain.readImage<uint64_t>(gbuffer.geometricNormal);
    const auto albedos = chain.readImage<uint64_t>(gbuffer.albedo);
    const ImageF image = chain.image("indirect");
    double difference = 0, sum = 0, largest = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        if (positions[i].w == 0) continue;
        const glm::vec3 point = (glm::vec3(positions[i]) - grid.origin) / grid.voxelSize;
        const glm::vec3 normal = glm::normalize(glm::vec3(glm::unpackHalf4x16(normals[i])));
        glm::vec3 irradiance(0.0f);
        float weights = 0;
        for (size_t s = 0; s < sorted.size(); ++s) {
            // A surfel on a border may belong to the voxel beyond it
            const glm::vec3 exact = (sorted[s].position - grid.origin) / grid.voxelSize;
            const glm::vec3 voxel = glm::round(exact - inVoxel(lit[s])), position = voxel + inVoxel(lit[s]);
            const glm::vec3 tent = glm::max(1.0f - glm::abs(voxel + 0.5f - point), glm::vec3(0.0f));
            const float voxelWeight = tent.x * tent.y * tent.z;
            if (voxelWeight == 0) continue;
            const float inverseDistance = std::bit_cast<float>(lit[s].normalAndDistance & 0xffff0000u);
            const float weight = voxelWeight * weightOf(position - point, normal, normalOf(lit[s]), inverseDistance,
                                                        light.relativeVariance);
            irradiance += weight * radiosity(lit[s].radiosity);
            weights += weight;
        }
        if (weights == 0) continue;
        const glm::vec3 expected = glm::vec3(glm::unpackHalf4x16(albedos[i])) * irradiance / (weights * 3.14159265f);
        for (int c = 0; c < 3; ++c) {
            const double found = image.pixel(uint32_t(i) % 32, uint32_t(i) / 32)[c];
            difference += std::abs(found - expected[c]);
            largest = std::max(largest, std::abs(found - expected[c]));
            sum += expected[c];
        }
    }
    const double mean = sum / double(3 * positions.size());
    std::printf("mean difference %.6f, largest %.6f, of the mean\n", difference / sum, largest / mean);
    // Rounding of floats; the image is in floats, the sums' orders differ
    EXPECT_LT(difference / sum, 1e-5);
    EXPECT_LT(largest / mean, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(PointsPerVoxel, GatherSurfelsTest, testing::Values(4, 40));

}  // namespace
}  // namespace voxray::test

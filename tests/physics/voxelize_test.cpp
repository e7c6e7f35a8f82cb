// Voxelization against what geometry says: areas, coverage, averages, and that no surface is missed.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/voxels.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

double surfaceArea(const Geometry& g) {
    double area = 0;
    for (const glm::uvec3 t : g.triangles)
        area += 0.5 * glm::length(glm::cross(g.positions[t.y] - g.positions[t.x],
                                             g.positions[t.z] - g.positions[t.x]));
    return area;
}

struct Voxels {
    explicit Voxels(Chain& chain) {
        resource = chain.graph().resource<SurfaceVoxels>("voxels");
        materials = chain.read<gpu::VoxelMaterial>(resource->materials);
        occupancy = chain.read<uint32_t>(resource->occupancy);
        rank = chain.read<uint32_t>(resource->rank);
    }
    bool occupied(glm::ivec3 v) const {
        const gpu::VoxelGrid& g = resource->grid;
        const size_t word = (size_t(v.z) * g.resolution.y + size_t(v.y)) * g.wordsPerRow + size_t(v.x) / 32;
        return (occupancy[word] >> (v.x % 32)) & 1u;
    }
    const SurfaceVoxels* resource;
    std::vector<gpu::VoxelMaterial> materials;
    std::vector<uint32_t> occupancy, rank;
};

TEST(Voxelize, SumsToTheSurfaceArea) {
    // A sphere has every orientation: the three projections' weights must add up to its area all the same.
    Chain chain("furnace", "{shape: sphere, albedo: 0.5}", "[{pass: voxelize, resolution: 48, samples: 4}]");
    const Voxels voxels(chain);
    double area = 0;
    glm::dvec3 exposed(0.0);
    for (const gpu::VoxelMaterial& m : voxels.materials) {
        area += m.area;
        exposed += glm::dvec3(m.exposedPositive + m.exposedNegative);
    }
    const double face = double(voxels.resource->grid.voxelSize) * voxels.resource->grid.voxelSize;
    const double expected = surfaceArea(chain.state().geometry);
    EXPECT_NEAR(area * face / expected, 1.0, 0.005);
    // Nothing is near either side of a large sphere: both are exposed.
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(exposed[axis] * face / (2 * expected / 3), 1.0, 0.01);
}

TEST(Voxelize, InnerSidesOfThinWallsAreNotExposed) {
    // Cornell's boxes are closed shells; at 4 voxels along the room each side faces another within a voxel,
    // so that the shells' inner sides drop out. At 64 voxels they are wider than a voxel and count.
    const auto exposedShare = [](uint32_t resolution) {
        Chain chain("cornell", "{}",
                    "[{pass: voxelize, samples: 8, resolution: " + std::to_string(resolution) + "}]");
        const Voxels voxels(chain);
        double area = 0, exposed = 0;
        for (const gpu::VoxelMaterial& m : voxels.materials) {
            area += 2 * m.area;
            for (int axis = 0; axis < 3; ++axis) exposed += m.exposedPositive[axis] + m.exposedNegative[axis];
        }
        return exposed / area;
    };
    EXPECT_GT(exposedShare(64), 0.95);
    EXPECT_LT(exposedShare(3), exposedShare(64) - 0.05);
}

TEST(Voxelize, RanksCountOccupiedVoxels) {
    Chain chain("cornell", "{}", "[{pass: voxelize, resolution: 40}]");
    const Voxels voxels(chain);
    uint32_t before = 0;
    for (size_t word = 0; word < voxels.occupancy.size(); ++word) {
        ASSERT_EQ(voxels.rank[word], before) << "word " << word;
        before += uint32_t(std::popcount(voxels.occupancy[word]));
    }
    EXPECT_EQ(before, voxels.resource->voxelCount);
    EXPECT_EQ(voxels.materials.size(), voxels.resource->voxelCount);
}

TEST(Voxelize, FindsEveryPointOfTheSurface) {
    // Points spread over all triangles of Cornell lie in occupied voxels.
    Chain chain("cornell", "{}", "[{pass: voxelize, resolution: 64, samples: 2}]");
    const Voxels voxels(chain);
    const Geometry& g = chain.state().geometry;
    const gpu::VoxelGrid& grid = voxels.resource->grid;
    size_t points = 0, missed = 0;
    for (const glm::uvec3 t : g.triangles) {
        for (int i = 0; i <= 60; ++i) {
            for (int j = 0; i + j <= 60; ++j) {
                const float u = float(i) / 60, v = float(j) / 60;
                const glm::vec3 p =
                    g.positions[t.x] * (1 - u - v) + g.positions[t.y] * u + g.positions[t.z] * v;
                ++points;
                if (!voxels.occupied(glm::ivec3(glm::floor((p - grid.origin) / grid.voxelSize)))) ++missed;
            }
        }
    }
    // A point's voxel may be one that the surface only grazes, with no sample in it: rare at edges, none
    // inside.
    EXPECT_LT(double(missed) / double(points), 0.01);
}

TEST(Voxelize, AveragesMaterials) {
    Chain chain("furnace", "{shape: box, albedo: 0.25, emission: 3}", "[{pass: voxelize, resolution: 16}]");
    const Voxels voxels(chain);
    for (const gpu::VoxelMaterial& m : voxels.materials) {
        ASSERT_NEAR(m.albedo.x, 0.25, 1e-3);
        ASSERT_NEAR(m.emission.y, 3.0, 1e-2);
        ASSERT_LE(glm::length(m.normal), 1.001f);
        ASSERT_GT(m.opacity, 0.0f);
        ASSERT_LE(m.opacity, 1.0f);
    }
}

TEST(Voxelize, GridOfOneVoxel) {
    Chain chain("cornell", "{}", "[{pass: voxelize, resolution: 1}]");
    const Voxels voxels(chain);
    EXPECT_EQ(voxels.resource->voxelCount, 1u);
}

TEST(Voxelize, IsDeterministic) {
    const auto run = [] {
        Chain chain("cornell", "{}", "[{pass: voxelize, resolution: 32}]");
        return Voxels(chain).materials;
    };
    const auto a = run(), b = run();
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0);
}

}  // namespace
}  // namespace voxray::test

// The layout svo_bricks of filter_voxels, the octree of Arnebäck 2017 as published, against its own closed
// form.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtx/component_wise.hpp>

#include "image/metrics.h"
#include "passes/common/voxels/voxels.h"
#include "scene/shapes.h"
#include "tests/gpu/radiance_samples.h"
#include "tests/support/brick_octree_count.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr double kCode = 1.0 / 255;  // The step of 8 bits.

std::string filterGraph(const std::string& layout, const std::string& resolution, const std::string& more = "") {
    return graphYaml({"voxelize, directions: 1, resolution: " + resolution,
                      "inject_light_rays, rays_per_light: 65536, bounces: 2",
                      "filter_voxels, layout: " + layout + more});
}

/// What a level's samples are made of, in doubles: values half a voxel apart, on nodes' corners and between.
struct Lattice {
    glm::ivec3 nodes;  ///< Of the level.
    std::vector<glm::dvec4> values;

    explicit Lattice(glm::uvec3 size) : nodes(size), values(size_t(glm::compMul(2 * nodes + 1))) {}
    glm::ivec3 last() const { return 2 * nodes; }
    size_t index(glm::ivec3 at) const {
        return (size_t(at.z) * size_t(2 * nodes.y + 1) + size_t(at.y)) * size_t(2 * nodes.x + 1) + size_t(at.x);
    }
    /// Outside nothing.
    glm::dvec4 operator[](glm::ivec3 at) const {
        const bool inside =
            glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) && glm::all(glm::lessThanEqual(at, last()));
        return inside ? values[index(at)] : glm::dvec4(0.0);
    }
    template <typename Value>
    void fill(const Value& value) {
        for (glm::ivec3 at(0); at.z <= last().z; ++at.z)
            for (at.y = 0; at.y <= last().y; ++at.y)
                for (at.x = 0; at.x <= last().x; ++at.x) values[index(at)] = value(at);
    }
};

/// The mean of the leaves that meet in each place, which stand in `centers`.
Lattice leafLattice(const Lattice& centers) {
    Lattice result(glm::uvec3(centers.nodes));
    result.fill([&](glm::ivec3 at) {
        glm::dvec4 sum(0.0);
        int met = 0;
        for (int octant = 0; octant < 8; ++octant) {
            const glm::ivec3 side = (glm::ivec3(octant, octant >> 1, octant >> 2) & 1) * 2 - 1;
            glm::ivec3 center;
            for (int k = 0; k < 3; ++k) center[k] = at[k] % 2 ? at[k] : at[k] + side[k];
            if (glm::any(glm::lessThan(center, glm::ivec3(0))) || glm::any(glm::greaterThan(center, centers.last())))
                continue;
            sum += centers[center];
            ++met;
        }
        return sum / double(met);
    });
    return result;
}

/// The next level's: 1/4 1/2 1/4 along each axis; on the border of the grid, where the neighbor that would
/// bring its half of the rest is missing, 1/4 1/4.
Lattice coarser(const Lattice& finer) {
    Lattice result((glm::uvec3(finer.nodes) + 1u) / 2u);
    result.fill([&](glm::ivec3 at) {
        glm::dvec4 sum(0.0);
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x) {
                    const glm::ivec3 offset(x, y, z);
                    double weight = 1;
                    for (int k = 0; k < 3; ++k) {
                        const bool onBorder = at[k] == 0 || at[k] == result.last()[k];
                        weight *= offset[k] == 0 && !onBorder ? 0.5 : 0.25;
                    }
                    sum += weight * finer[2 * at + offset];
                }
        return sum;
    });
    return result;
}

/// Linear between the values round a place, in nodes of the level.
glm::dvec4 interpolated(const Lattice& lattice, glm::dvec3 place) {
    const glm::dvec3 first = glm::floor(2.0 * place), upper = 2.0 * place - first;
    glm::dvec4 sum(0.0);
    for (int octant = 0; octant < 8; ++octant) {
        const glm::ivec3 offset = glm::ivec3(octant, octant >> 1, octant >> 2) & 1;
        const glm::dvec3 w = glm::mix(1.0 - upper, upper, glm::dvec3(offset));
        sum += w.x * w.y * w.z * lattice[glm::ivec3(first) + offset];
    }
    return sum;
}

/// Places on each level, in voxels of it.
struct LevelPlaces {
    std::vector<glm::vec3> places;
    std::vector<RadianceQuery> queries;
};
LevelPlaces randomPlaces(const gpu::RadianceGrid& grid, uint32_t level, size_t count) {
    std::mt19937 random(level + 1);
    std::uniform_real_distribution<float> uniform(0, 1);
    const glm::vec3 size(levelResolution(grid.resolution, level));
    const float voxel = grid.voxelSize * float(1u << level);
    LevelPlaces result;
    for (size_t i = 0; i < count; ++i) {
        result.places.push_back(size * glm::vec3(uniform(random), uniform(random), uniform(random)));
        result.queries.push_back({grid.origin + voxel * result.places.back(), voxel, {1, 0, 0}});
    }
    return result;
}

TEST(SvoBricks, AreTheGaussianPyramidOfTheirVoxels) {
    // Leaves of the full grids' level 0, at a resolution that no power of two divides, with walls along the
    // grid's border. Each value is rounded when it is written: the leaf's and its mean along three axes, half
    // a code each; on a further level up to eight parts.
    const Chain dense("cornell", "{lights: point}", filterGraph("dense", "19")),
        bricks("cornell", "{lights: point}", filterGraph("svo_bricks", "19"));
    const gpu::RadianceGrid& grid = radiance(dense).grid;
    Lattice centers(grid.resolution);
    std::vector<RadianceQuery> queries;
    std::vector<glm::ivec3> cells;
    centers.fill([&](glm::ivec3 at) {
        if (at.x % 2 && at.y % 2 && at.z % 2) {
            cells.push_back(at);
            queries.push_back({grid.origin + 0.5f * grid.voxelSize * glm::vec3(at), grid.voxelSize, {1, 0, 0}});
        }
        return glm::dvec4(0.0);
    });
    const std::vector<glm::vec4> met = sampleRadiance(dense, queries);
    double brightest = 0;
    for (size_t i = 0; i < cells.size(); ++i) {
        centers.values[centers.index(cells[i])] = met[i];
        brightest = std::max<double>(brightest, glm::compMax(glm::vec3(met[i])));
    }
    ASSERT_GT(brightest, 0.05);

    Lattice lattice = leafLattice(centers);
    for (uint32_t level = 0; level < grid.levels; ++level) {
        if (level > 0) lattice = coarser(lattice);
        const LevelPlaces p = randomPlaces(grid, level, 50000);
        const std::vector<glm::vec4> found = sampleRadiance(bricks, p.queries);
        double worst = 0, largest = 0, sum = 0;
        for (size_t i = 0; i < found.size(); ++i) {
            const glm::dvec4 expected = interpolated(lattice, p.places[i]);
            const glm::dvec4 error = glm::abs(expected - glm::dvec4(found[i])) / glm::dvec4(glm::dvec3(brightest), 1.0);
            worst = std::max(worst, glm::compMax(error));
            largest = std::max(largest, expected.a);
            sum += error.a;
        }
        std::printf("level %u: opacity up to %.3f, off by at most %.2f codes, %.3f in the mean\n", level, largest,
                    worst / kCode, sum / double(found.size()) / kCode);
        EXPECT_LT(worst, (2.1 + 4 * level) * kCode) << level;
        EXPECT_GT(largest, 0.05) << level;
    }
}

TEST(SvoBricks, MixTheSidesOfALampEvenly) {
    // Floors that emit 3 from their upper sides and reflect nothing: half of each voxel's area is lit. So
    // radiance over opacity is 1.5 at each place and on each level, up to the rounding of both.
    SceneBuilder b("floors");
    const uint32_t lamp = b.lambert("lamp", glm::vec3(0.0f), glm::vec3(3.0f));
    for (const float height : {0.0f, 1.0f}) b.quad("floor", {-1, height, -1}, {0, 0, 2}, {2, 0, 0}, lamp);
    b.pointLight({0, 2, 0}, glm::vec3(1.0f));
    b.camera({0, 2, 0}, {0, 0, 0.1f}, 60);
    const Chain chain(evaluated(b), filterGraph("svo_bricks", "24", ", emission: true"), 8, 8);
    size_t tested = 0;
    for (uint32_t level = 0; level < radiance(chain).grid.levels; ++level) {
        const LevelPlaces p = randomPlaces(radiance(chain).grid, level, 5000);
        for (const glm::vec4& met : sampleRadiance(chain, p.queries)) {
            const double rounding = (2.1 + 4 * level) * kCode;
            ASSERT_NEAR(met.g, 1.5 * met.a, 2 * 1.5 * rounding) << level;
            tested += met.a > 0.25f;
        }
    }
    EXPECT_GT(tested, 2000);
}

TEST(SvoBricks, AreLinearInLightAndTheSameEachTime) {
    const auto samples = [](const std::string& emission) {
        return samplesOf(Chain("furnace", "{shape: box, albedo: 0.5, emission: " + emission + "}",
                               filterGraph("svo_bricks", "20", ", emission: true")));
    };
    const std::vector<glm::vec4> one = samples("1"), again = samples("1"), eight = samples("8");
    for (size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(one[i], again[i]) << i;
        ASSERT_EQ(glm::vec3(eight[i]), 8.0f * glm::vec3(one[i])) << i;
        ASSERT_EQ(eight[i].a, one[i].a) << i;
    }
}

TEST(SvoBricks, FollowALightThatChanges) {
    // Structure stays, values are new: as if it had been so from the start.
    const std::string graph = filterGraph("svo_bricks", "16");
    const auto state = [](float intensity) {
        auto made = builtin("cornell", "{lights: point}");
        made->lights.at(0).intensity *= intensity;
        made->lights.at(0).position.x += 0.1f * intensity;
        return made;
    };
    Chain changed(state(1), graph, 16, 16);
    changed.update([&](SceneState& scene) {
        scene.lights = state(3)->lights;
        return std::vector<Box>{};
    });
    EXPECT_EQ(samplesOf(changed), samplesOf(Chain(state(3), graph, 16, 16)));
}

TEST(SvoBricks, TakeWhatTheHostCounts) {
    for (const std::string scene : {"cornell", "thin_wall", "spheres"}) {
        const Chain chain(
            scene, "{}",
            graphYaml({"voxelize, resolution: 48, directions: 1", "inject_light_rays, rays_per_light: 1024, bounces: 0",
                       "filter_voxels, layout: svo_bricks"}));
        const SurfaceVoxels& voxels = chain.get<SurfaceVoxels>("voxels");
        const BrickOctreeCount count = countBrickOctree(metVoxels(chain.state().geometry, voxels.grid));
        EXPECT_NEAR(double(radiance(chain).storage[1].bytes()) / double(count.bricks() * kBrickBytes), 1.0, 0.03)
            << scene;
        EXPECT_NEAR(double(chain.graph().memory().back().bytes) / double(count.bytes()), 1.0, 0.03) << scene;
    }
}

/// Voxels 3 and 4 along x and z of eight, of which one of four has no surface: (x, z) = (4, 3).
State threeOfFour() {
    SceneBuilder b("three_of_four");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.box("low corner", {0.005f, 0, 0.005f}, glm::vec3(0.01f), 0, grey);
    b.box("high corner", {7.995f, 7.99f, 7.995f}, glm::vec3(0.01f), 0, grey);
    const float voxel = 8 / 7.75f, first = -0.125f * voxel;
    const auto floor = [&](int x, int z, float part) {
        const glm::vec3 corner = first + voxel * glm::vec3(float(x) + 0.02f, 3.5f, float(z) + 0.02f);
        b.quad("floor", corner, {0, 0, 0.96f * voxel}, {0.96f * part * voxel, 0, 0}, grey);
    };
    floor(3, 3, 1);
    floor(3, 4, 0.5f);
    floor(4, 4, 0.75f);
    b.pointLight({4, 7, 4}, glm::vec3(50.0f));
    b.camera({4, 7, 4}, {4, 0, 4.1f}, 60);
    return evaluated(b);
}

TEST(SvoBricks, DifferWhereANeighborIsMissing) {
    // Figure 28. Where the four voxels meet, all bricks hold their mean. Without the empty one means are
    // taken along x, then along z, each of the two that there are.
    const auto opacities = [](const std::string& neighbors) {
        const Chain chain(
            threeOfFour(),
            graphYaml({"voxelize, resolution: 8, directions: 1, visibility_rays: 0", "inject_light_rays, bounces: 0",
                       "filter_voxels, layout: svo_bricks, brick_neighbors: " + neighbors}),
            8, 8);
        const gpu::RadianceGrid& g = radiance(chain).grid;
        EXPECT_EQ(g.resolution, glm::uvec3(8));
        std::vector<RadianceQuery> queries;
        for (const glm::vec2 xz : {glm::vec2(3.5f, 3.5f), glm::vec2(3.5f, 4.5f), glm::vec2(4.5f, 4.5f),
                                   glm::vec2(3.999f, 3.999f), glm::vec2(3.999f, 4.001f), glm::vec2(4.001f, 4.001f)})
            queries.push_back({g.origin + g.voxelSize * glm::vec3(xz.x, 3.5f, xz.y), g.voxelSize, {1, 0, 0}});
        return sampleRadiance(chain, queries);
    };
    const std::vector<glm::vec4> whole = opacities("true"), missing = opacities("false");
    const float sw = whole[0].a, nw = whole[1].a, ne = whole[2].a;
    EXPECT_GT(sw, 1.2f * ne);
    EXPECT_GT(ne, 1.2f * nw);
    for (size_t i = 3; i < 6; ++i) EXPECT_NEAR(whole[i].a, (sw + nw + ne) / 4, 0.012) << i;
    EXPECT_NEAR(missing[3].a, (sw + (nw + ne) / 2) / 2, 0.012);
    EXPECT_NEAR(missing[4].a, (sw + (nw + ne) / 2) / 2, 0.012);
    EXPECT_NEAR(missing[5].a, (nw + ne) / 2, 0.012);
}

TEST(SvoBricks, ErrLittleMoreThanFullGrids) {
    // Indirect light of a room against the path tracer, as voxels shrink: with one value for all directions
    // walls become translucent on coarse levels, so that in full grids, too, errors grow with the number of
    // levels. 8 bits and the wider kernel add up to a third.
    const std::string room = "{lights: point}";
    const ImageF reference =
        Chain("cornell", room, graphYaml({"path_trace, spp: 256, bounces: 3"}), 24, 24).image("indirect");
    const auto error = [&](const std::string& layout, const std::string& resolution, const std::string& gather) {
        const std::string inject = "inject_light_rays, rays_per_light: 262144, bounces: 2";
        const std::string voxelize = "voxelize, directions: 1, resolution: " + resolution;
        const std::string filter = "filter_voxels, layout: " + layout;
        Chain chain("cornell", room, graphYaml({"gbuffer", voxelize, inject, filter, gather}), 24, 24);
        return relMse(chain.image("indirect"), reference);
    };
    for (const std::string gather : {"gather_cones, visibility: voxels, specular: 0", "gather_stepped_cones"})
        for (const std::string resolution : {"8", "16", "32"}) {
            const double bricks = error("svo_bricks", resolution, gather);
            const double dense = error("dense", resolution, gather);
            std::printf("%s at %s: %.3f, full grids %.3f\n", gather.c_str(), resolution.c_str(), bricks, dense);
            EXPECT_LT(bricks, 1.33 * dense) << gather << ' ' << resolution;
            EXPECT_GT(bricks, 0.9 * dense) << gather << ' ' << resolution;
        }
}

TEST(SvoBricks, RefuseWhatWasNotPublished) {
    EXPECT_ERROR("voxelize's 'directions'",
                 Chain("cornell", "{}",
                       graphYaml({"voxelize, resolution: 16, directions: 6", "inject_light_rays, bounces: 0",
                                  "filter_voxels, layout: svo_bricks"})));
}

TEST(SvoBricks, FollowSurfacesThatMove) {
    // The whole octree is built again: as if surfaces had been there from the start.
    const auto scene = cornellWithBall({});
    const std::string graph = filterGraph("svo_bricks", "24");
    const auto moved = chainAt(scene, 0, graph);
    const std::vector<glm::vec4> before = samplesOf(*moved);
    moved->goTo(0.4);
    EXPECT_EQ(samplesOf(*moved), samplesOf(*chainAt(scene, 0.4, graph)));
    EXPECT_NE(samplesOf(*moved), before);
}

}  // namespace
}  // namespace voxray::test

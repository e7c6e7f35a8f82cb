// Clusters of voxels: how voxels are assigned, and form factors between patches and clusters.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "passes/clusters/voxel_clusters.h"
#include "tests/physics/cluster_graph.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// Clusters of a chain, read back.
struct Clusters {
    explicit Clusters(Chain& chain) : voxels(chain) {
        const auto& c = chain.get<VoxelClusters>("clusters");
        clusters = chain.read<gpu::VoxelCluster>(c.clusters);
        clusterOfVoxel = chain.read<uint32_t>(c.clusterOfVoxel);
        coordinates = chain.read<glm::uvec3>(c.coordinates);
        unassigned = reported(chain.buildSamples.at(1), "voxels that no seed reached, %");
    }
    Voxels voxels;
    std::vector<gpu::VoxelCluster> clusters;
    std::vector<uint32_t> clusterOfVoxel;
    std::vector<glm::uvec3> coordinates;
    double unassigned;  ///< Voxels that algorithm 1 left without a cluster, %.
};

Clusters clustersOf(const std::string& scene, const std::string& parameters, const std::string& pass,
                    const std::string& resolution = "32") {
    Chain chain(scene, parameters, graphYaml({"voxelize, resolution: " + resolution, "cluster_voxels, " + pass}), 16,
                16);
    return Clusters(chain);
}

int64_t unassigned(const Clusters& c) {
    return std::ranges::count(c.clusterOfVoxel, NO_CLUSTER);
}

/// As voxel_normals.comp has it; not a number where that takes the largest face.
glm::vec3 normalOf(const gpu::VoxelMaterial& m) {
    const glm::vec3 difference = m.unoccludedPositive - m.unoccludedNegative;
    const glm::vec3 sum = m.unoccludedPositive + m.unoccludedNegative, one(1);
    if (glm::dot(glm::abs(difference), one) > 0.01f * glm::dot(sum, one))
        return glm::normalize(glm::sign(difference) * glm::sqrt(glm::abs(difference)));
    return glm::dot(m.normal, m.normal) > 1e-4f ? glm::normalize(m.normal) : glm::vec3(NAN);
}

const std::vector<std::string> kKinds = {"target: 200, assign: nearest", "target: 200, assign: first",
                                         "initial: 3000, assign: first", "target: 200, normals: open_space"};

TEST(ClusterVoxels, GroupEachVoxelOnceAndTheSameInEachRun) {
    for (const std::string& kind : kKinds) {
        const Clusters c = clustersOf("cornell", "{lights: point}", kind);
        const Clusters again = clustersOf("cornell", "{lights: point}", kind);
        EXPECT_EQ(c.clusterOfVoxel, again.clusterOfVoxel) << kind;
        std::vector<uint32_t> memberCounts(c.clusters.size());
        for (const uint32_t cluster : c.clusterOfVoxel) ++memberCounts.at(cluster);  // 0 unassigned.
        for (uint32_t i = 0; i < c.clusters.size(); ++i) {
            EXPECT_GT(memberCounts[i], 0u) << kind;
            EXPECT_EQ(c.clusters[i].memberCount, memberCounts[i]) << kind;
        }
        std::printf("%s: %zu clusters of %u voxels, no seed reached %.2f %%\n", kind.c_str(), c.clusters.size(),
                    c.voxels.count, c.unassigned);
    }
}

TEST(ClusterVoxels, KeepNormalsWithinTheAngleLimit) {
    for (const double degrees : {35.0, 10.0}) {
        const Clusters c =
            clustersOf("cornell", "{lights: point}", "target: 200, max_angle: " + std::to_string(degrees));
        const double limit = std::cos(degrees * kPi / 180) - 1e-4;
        double worst = 1;
        uint32_t known = 0;
        for (uint32_t voxel = 0; voxel < c.voxels.count; ++voxel) {
            const double cosine =
                glm::dot(c.clusters[c.clusterOfVoxel[voxel]].seedNormal, normalOf(c.voxels.materials[voxel]));
            if (std::isnan(cosine)) continue;
            ++known;
            worst = std::min(worst, cosine);
        }
        EXPECT_GT(known, c.voxels.count / 2);
        EXPECT_GT(worst, limit) << degrees;
    }
}

TEST(ClusterVoxels, TakeWhatNoOtherWantsInThePapersOrder) {
    // A single seed begins on one of the six walls and reaches all of the room.
    const std::string few = "target: 1, iterations: 1, reach: 8, unassigned: leave, assign: ";
    const Clusters nearest = clustersOf("white_room", "{}", few + "nearest");
    const Clusters first = clustersOf("white_room", "{}", few + "first");
    EXPECT_GT(unassigned(nearest), 0);
    EXPECT_EQ(unassigned(first), 0);
    // Where each direction has its own clusters, nearly all voxels with a normal join one of like normal.
    const Clusters many = clustersOf("cornell", "{lights: point}", "target: 200, assign: first, reach: 4");
    uint32_t known = 0, beyond = 0;
    for (uint32_t voxel = 0; voxel < many.voxels.count; ++voxel) {
        const double cosine =
            glm::dot(many.clusters[many.clusterOfVoxel[voxel]].seedNormal, normalOf(many.voxels.materials[voxel]));
        if (std::isnan(cosine)) continue;
        ++known;
        beyond += cosine < std::cos(35 * kPi / 180) - 1e-4 ? 1 : 0;
    }
    std::printf("%u of %u voxels beyond the limit\n", beyond, known);
    EXPECT_GT(known, 100u);
    EXPECT_LT(beyond, known / 10);
}

TEST(ClusterVoxels, LeaveVoxelsOnlyWhereAsked) {
    const std::string few = "target: 12, iterations: 1, unassigned: ";
    const Clusters left = clustersOf("cornell", "{lights: point}", few + "leave");
    EXPECT_GT(unassigned(left), 0);
    EXPECT_NEAR(100.0 * double(unassigned(left)) / left.voxels.count, left.unassigned, 1e-6);
    EXPECT_EQ(unassigned(clustersOf("cornell", "{lights: point}", few + "own")), 0);
    const Clusters nearest = clustersOf("cornell", "{lights: point}", few + "nearest");
    EXPECT_EQ(unassigned(nearest), 0);
    EXPECT_EQ(nearest.clusters.size(), left.clusters.size());
}

TEST(ClusterVoxels, OfAPlaneHaveItsNormal) {
    const Clusters c = clustersOf("plane", "{}", "target: 50");
    EXPECT_GT(c.clusters.size(), 25u);
    EXPECT_LT(c.clusters.size(), 100u);
    double voxels = 0;
    for (const gpu::VoxelCluster& cluster : c.clusters) {
        EXPECT_NEAR(cluster.seedNormal.y, 1, 1e-4);
        voxels += cluster.memberCount;
    }
    EXPECT_EQ(voxels, c.voxels.count);
}

TEST(ClusterVoxels, TakeAnyNumberOfVoxelsAndClusters) {
    // One voxel; more clusters than voxels, of which each then is one; one cluster for each direction.
    EXPECT_EQ(clustersOf("cornell", "{lights: point}", "target: 5", "1").clusters.size(), 1u);
    const Clusters many = clustersOf("white_room", "{}", "target: 100000", "8");
    EXPECT_EQ(many.clusters.size(), many.voxels.count);
    const Clusters few = clustersOf("white_room", "{}", "target: 1");
    EXPECT_GE(few.clusters.size(), 6u);
    EXPECT_ERROR("target", clustersOf("plane", "{}", "target: 0"));
}

TEST(ClusterVisibility, CountsFormFactors) {
    // Parallel unit squares, 1 m apart: F = 0.19982 (Howell, C-11). The fraction of rays from patches +y of
    // the lower one that hit the upper one.
    for (const std::string visibility : {"voxels", "exact"}) {
        Chain chain(
            "quad_light", "{}",
            graphYaml({"voxelize, resolution: 32", "cluster_voxels, target: 100", "place_surfels", "find_patches",
                       "cluster_visibility, rays: 256, near_distance: 0, visibility: " + visibility}),
            16, 16);
        const Clusters c(chain);
        const auto& patches = chain.get<VoxelPatches>("patches");
        const auto groups = chain.read<gpu::SurfaceGroup>(patches.groups);
        const auto components = chain.read<gpu::ClusterComponent>(patches.components);
        const auto memberGroups = chain.read<uint32_t>(patches.memberGroups);
        const auto materials = chain.read<gpu::PackedGroupMaterial>(patches.materials);
        const auto above = pointsAbove(chain);
        const auto faces = facesOfPatches(groups), targets = facesOfComponents(chain);
        const auto lists = readVisibilityLists(chain);
        double sum = 0, area = 0;
        for (size_t i = 0; i < lists.size(); ++i) {
            const uint32_t group = faces[i] / 6;
            if (faces[i] % 6 != 2 || c.coordinates[groups[group].voxel].y > 16) continue;
            const double patchArea = gpu::unpackGroupMaterial(materials[group]).unoccludedPositive.y;
            area += patchArea;
            for (const VisibilityEntry& entry : lists[i])
                if (above[memberGroups[components[targets[entry.target] / 6].firstMember]].y > 0.5f)
                    sum += patchArea * entry.rays / 256;
        }
        std::printf("%s: form factor %.4f\n", visibility.c_str(), sum / area);
        // Through voxels rays begin one of 1/32 m above the square and end one before the other.
        EXPECT_NEAR(sum / area, 0.19982, visibility == "exact" ? 0.002 : 0.02);
    }
}

TEST(ClusterVisibility, KeepLongLists) {
    // In a closed sphere 1024 rays hit nearly as many clusters, of one voxel each. Walls that emit 1 and
    // reflect a half reflect a quarter of pi after the gather.
    Chain chain(
        "furnace", "{shape: sphere, albedo: 0.5, emission: 1}",
        graphYaml({"gbuffer", "voxelize, resolution: 12", "place_surfels", "cluster_voxels, target: 100000",
                   "find_patches", "cluster_visibility, rays: 1024, near_distance: 0",
                   "inject_clusters, direct: shadow_rays", "gather_clusters, filter_passes: 0", "gather_irradiance"}),
        16, 16);
    const double light = mean(chain.image("indirect")) / 0.25;
    std::printf("light %.4f of the closed form\n", light);
    EXPECT_NEAR(light, 1, 0.01);
}

/// Light of surface groups inside a sealed room whose floor and ceiling run on outside, into the sun, through
/// the same voxels, next to that of all others: means of radiosity, green.
double leakIntoARoom(const std::string& visibility, const std::string& direct, const std::string& near) {
    Chain chain("shell_room", "{wall_thickness: 0.1}",
                graphYaml(clusterGraph("rays_per_light: 262144, bounces: 0", "target: 400",
                                       "rays: 64, near_distance: " + near + ", visibility: " + visibility,
                                       "2, direct: " + direct, "filter_passes: 2", "25")));
    const auto groups = readGroups(chain);
    const auto above = pointsAbove(chain);
    const auto light = readRadiosity(chain);
    double inside = 0, outside = 0, insideCount = 0, outsideCount = 0;
    for (size_t i = 0; i < above.size(); ++i) {
        double sum = 0;
        for (uint32_t k = groups[i].firstPatch; k < groups[i + 1].firstPatch; ++k) sum += light[k];
        const glm::vec3 p = above[i];
        const bool isInside = std::abs(p.x) < 2 && p.y > 0 && p.y < 2.5f && std::abs(p.z) < 2;
        (isInside ? inside : outside) += sum;
        (isInside ? insideCount : outsideCount) += 1;
    }
    EXPECT_GT(insideCount, 100);
    return inside / insideCount / (outside / outsideCount);
}

TEST(ClusterVisibility, DoNotLeakThroughWallsThinnerThanAVoxel) {
    // Voxels of 0.33 m, walls of 0.1 m, and voxels that hold the floor on both sides of a wall: at 24, where
    // voxels end within the walls, nothing leaks.
    for (const std::string near : {"0", "4"}) {
        const double leak = leakIntoARoom("exact", "shadow_rays", near);
        std::printf("near %s: %.5f inside of what is outside\n", near.c_str(), leak);
        EXPECT_LT(leak, 0.01);
    }
    // What injected light, rays through voxels and points round voxels do there.
    EXPECT_GT(leakIntoARoom("exact", "injected", "4"), 0.01);
    EXPECT_GT(leakIntoARoom("voxels", "shadow_rays", "4"), 0.01);
    const double byPoints = leakIntoARoom("exact", "shadow_rays, lit_test: points", "4");
    std::printf("points round voxels: %.5f\n", byPoints);
    EXPECT_GT(byPoints, 0.01);
}

TEST(ClusterVisibility, LookAlongTheNormalOfEachWallOfACorner) {
    // Voxels hold one mean normal. Where walls across axes meet, the patches before each look along its axis
    // alone, whatever part of the area each has: the same light by both hemispheres. Furniture that stands
    // at an angle has other light by its faces' axes.
    struct Light {
        std::vector<float> flux;      ///< By voxel and face, 3 floats each.
        std::vector<uint32_t> faces;  ///< By voxel: a bit for each face that a surfel's normal is along.
        std::vector<bool> isAligned;  ///< By voxel: whether all of its surfels look along axes.
    };
    const auto lightOf = [](const std::string& hemisphere) {
        Chain chain("clutter", "{}",
                    graphYaml(clusterGraph(kDirect, "target: 100", "rays: 64, hemisphere: " + hemisphere, "0",
                                           "filter_passes: 0", "19")));
        Light light;
        light.flux = readFlux(chain, chain.get<VoxelIrradiance>("irradiance").indirect);
        light.faces.resize(light.flux.size() / 18);
        light.isAligned.resize(light.faces.size(), true);
        for (const gpu::Surfel& s : readSurfels(chain))
            for (int axis = 0; axis < 3; ++axis) {
                const float cosine = s.normal[axis];
                if (std::abs(cosine) > 0.999f)
                    light.faces[s.voxel] |= 1u << (2 * axis + (cosine < 0 ? 1 : 0));
                else if (std::abs(cosine) > 0.001f)
                    light.isAligned[s.voxel] = false;
            }
        return light;
    };
    const Light surface = lightOf("surface"), face = lightOf("face");
    ASSERT_EQ(surface.flux.size(), face.flux.size());
    double corners = 0, difference[2] = {}, sum[2] = {};
    for (size_t i = 0; i < face.flux.size(); ++i) {
        const bool isAligned = face.isAligned[i / 18];
        difference[isAligned] += std::abs(surface.flux[i] - face.flux[i]);
        sum[isAligned] += face.flux[i];
        if (i % 18 == 0 && isAligned && std::popcount(face.faces[i / 18]) > 1) ++corners;
    }
    std::printf("%.0f corners: %.6f of the light differs, at slanted surfaces %.4f\n", corners, difference[1] / sum[1],
                difference[0] / sum[0]);
    EXPECT_GT(corners, 100);
    EXPECT_LT(difference[1], 1e-4 * sum[1]);
    EXPECT_GT(difference[0], 0.01 * sum[0]);
}

TEST(ClusterVisibility, RefusesWhatMakesNoSense) {
    const auto message = [](const std::string& visibility) {
        return errorOf([&] {
            Chain chain("cornell", "{lights: point}",
                        graphYaml(clusterGraph(kDirect, "target: 50", visibility, "0", "filter_size: 3")));
        });
    };
    EXPECT_CONTAINS(message("rays: 0"), "rays");
    EXPECT_CONTAINS(message("rays: 2000"), "rays");
    // All surfaces in one voxel: none is open to light.
    EXPECT_ERROR("no light",
                 Chain("cornell", "{lights: point}",
                       graphYaml(clusterGraph(kDirect, "target: 50", "rays: 16", "0", "filter_size: 3", "1"))));
    EXPECT_ERROR("find_patches", Chain("cornell", "{lights: point}",
                                       graphYaml({"voxelize, resolution: 16, visibility_rays: 0", "place_surfels",
                                                  "cluster_voxels", "find_patches"})));
}

}  // namespace
}  // namespace voxray::test

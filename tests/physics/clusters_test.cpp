// Clusters of voxels: how voxels are grouped, what faces see of them, and light that is gathered from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <set>

#include "passes/common/clusters/cluster_light.h"
#include "passes/common/clusters/cluster_visibility.h"
#include "passes/common/clusters/voxel_clusters.h"
#include "passes/common/clusters/voxel_patches.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Clusters of a chain, read back.
struct Clusters {
    explicit Clusters(Chain& chain) : voxels(chain) {
        const auto* resource = chain.graph().resource<VoxelClusters>("clusters");
        clusters = chain.read<gpu::VoxelCluster>(resource->clusters);
        ofVoxel = chain.read<uint32_t>(resource->ofVoxel);
        members = chain.read<uint32_t>(resource->members);
        coordinates = chain.read<glm::uvec3>(resource->coordinates);
        seen = reported(chain.buildSamples.at(1), "voxels no seed reached, %");
    }
    Voxels voxels;
    std::vector<gpu::VoxelCluster> clusters;
    std::vector<uint32_t> ofVoxel, members;
    std::vector<glm::uvec3> coordinates;
    double seen;  ///< Voxels that no seed's cluster asked for, %.
};

Clusters clustersOf(const std::string& scene, const std::string& parameters, const std::string& pass,
                    const std::string& resolution = "32") {
    Chain chain(scene, parameters,
                graphYaml({"voxelize, resolution: " + resolution, "cluster_voxels, " + pass}), 16, 16);
    return Clusters(chain);
}

/// As normals.comp has it, for surfaces of one way alone.
glm::vec3 normalOf(const gpu::VoxelMaterial& m) {
    const glm::vec3 net = m.unoccludedPositive - m.unoccludedNegative;
    return glm::normalize(glm::sign(net) * glm::sqrt(glm::abs(net)));
}

const std::vector<std::string> kKinds = {"target: 200, assign: nearest", "target: 200, assign: first",
                                         "initial: 3000, assign: first", "target: 200, normals: open_space"};

TEST(ClusterVoxels, GroupEachVoxelOnceAndTheSameInEachRun) {
    for (const std::string& kind : kKinds) {
        const Clusters c = clustersOf("cornell", "{lights: point}", kind);
        const Clusters again = clustersOf("cornell", "{lights: point}", kind);
        EXPECT_EQ(c.ofVoxel, again.ofVoxel) << kind;
        EXPECT_EQ(c.members, again.members) << kind;
        std::vector<bool> isListed(c.voxels.count, false);
        uint32_t next = 0;
        for (uint32_t i = 0; i < c.clusters.size(); ++i) {
            const gpu::VoxelCluster& cluster = c.clusters[i];
            ASSERT_GT(cluster.members, 0u);
            EXPECT_EQ(cluster.firstMember, next);
            next += cluster.members;
            for (uint32_t k = 0; k < cluster.members; ++k) {
                const uint32_t voxel = c.members[cluster.firstMember + k];
                EXPECT_FALSE(isListed[voxel]);
                isListed[voxel] = true;
                EXPECT_EQ(c.ofVoxel[voxel], i);
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(c.coordinates[voxel], cluster.first)));
                EXPECT_TRUE(glm::all(glm::lessThanEqual(c.coordinates[voxel], cluster.last)));
            }
        }
        EXPECT_EQ(next, c.voxels.count) << "0 unassigned: " << kind;
        std::printf("%s: %zu clusters of %u voxels, no seed reached %.2f %%\n", kind.c_str(),
                    c.clusters.size(), c.voxels.count, c.seen);
    }
}

TEST(ClusterVoxels, KeepNormalsWithinTheAngleLimit) {
    for (const double degrees : {35.0, 10.0})
        for (const std::string assign : {"first", "nearest"}) {
            const Clusters c =
                clustersOf("cornell", "{lights: point}",
                           "target: 200, assign: " + assign + ", max_angle: " + std::to_string(degrees));
            const double limit = std::cos(degrees * kPi / 180) - 1e-4;
            double worst = 1;
            for (uint32_t voxel = 0; voxel < c.voxels.count; ++voxel)
                worst = std::min(worst, double(glm::dot(c.clusters[c.ofVoxel[voxel]].axis,
                                                        normalOf(c.voxels.materials[voxel]))));
            EXPECT_GT(worst, limit) << assign << degrees;
        }
}

TEST(ClusterVoxels, LeaveVoxelsOnlyWhereAsked) {
    const std::string few = "target: 12, iterations: 1, unassigned: ";
    const auto unassigned = [](const Clusters& c) { return std::ranges::count(c.ofVoxel, NO_CLUSTER); };
    const Clusters left = clustersOf("cornell", "{lights: point}", few + "leave");
    EXPECT_GT(unassigned(left), 0);
    EXPECT_NEAR(100.0 * double(unassigned(left)) / left.voxels.count, left.seen, 1e-6);
    EXPECT_EQ(unassigned(clustersOf("cornell", "{lights: point}", few + "own")), 0);
    const Clusters nearest = clustersOf("cornell", "{lights: point}", few + "nearest");
    EXPECT_EQ(unassigned(nearest), 0);
    EXPECT_EQ(nearest.clusters.size(), left.clusters.size());
}

TEST(ClusterVoxels, OfAPlaneLookItsWay) {
    const Clusters c = clustersOf("plane", "{}", "target: 50");
    EXPECT_GT(c.clusters.size(), 25u);
    EXPECT_LT(c.clusters.size(), 100u);
    double voxels = 0;
    for (const gpu::VoxelCluster& cluster : c.clusters) {
        EXPECT_NEAR(cluster.normal.y, 1, 1e-4);
        EXPECT_NEAR(cluster.albedo.x, 0.5, 1e-3);
        voxels += cluster.members;
    }
    EXPECT_EQ(voxels, c.voxels.count);
}

TEST(ClusterVoxels, TakeAnyNumberOfVoxelsAndClusters) {
    // One voxel; more clusters than voxels, of which each then is one; one cluster for each way.
    EXPECT_EQ(clustersOf("cornell", "{lights: point}", "target: 5", "1").clusters.size(), 1u);
    const Clusters many = clustersOf("white_room", "{}", "target: 100000", "8");
    EXPECT_EQ(many.clusters.size(), many.voxels.count);
    const Clusters few = clustersOf("white_room", "{}", "target: 1");
    EXPECT_GE(few.clusters.size(), 6u);
    EXPECT_CONTAINS(errorOf([] { clustersOf("plane", "{}", "target: 0"); }), "target");
}

std::vector<std::string> clusterGraph(const std::string& inject, const std::string& cluster,
                                      const std::string& visibility, const std::string& bounces,
                                      const std::string& gather, const std::string& resolution = "24") {
    return {"gbuffer",
            "voxelize, resolution: " + resolution,
            "place_surfels",
            "inject_light_rays, " + inject,
            "cluster_voxels, " + cluster,
            "find_patches",
            "cluster_visibility, " + visibility,
            "inject_clusters, bounces: " + bounces,
            "gather_clusters, " + gather,
            "gather_irradiance"};
}

/// What all faces hold of indirect light, W, green.
double indirectFlux(Chain& chain) {
    const std::vector<float> flux =
        readFlux(chain, chain.graph().resource<VoxelIrradiance>("irradiance")->indirect);
    double sum = 0;
    for (size_t i = 1; i < flux.size(); i += 3) sum += flux[i];
    return sum;
}

const std::string kDirect = "rays_per_light: 262144, bounces: 0";

/// Sides that split the surfaces of a chain's voxels.
std::vector<gpu::SurfaceSide> readSides(Chain& chain) {
    return chain.read<gpu::SurfaceSide>(chain.graph().resource<VoxelPatches>("patches")->sides);
}

/// Calls f with the side of each patch and the number of its rays that met a target.
template <class F>
void forEachPatch(Chain& chain, F f) {
    for (const ClusterVisibility::Chunk& chunk :
         chain.graph().resource<ClusterVisibility>("cluster_visibility")->chunks) {
        const auto faces = chain.read<uint32_t>(chunk.faces), first = chain.read<uint32_t>(chunk.first);
        const auto seen = chain.read<uint32_t>(chunk.seen);
        for (uint32_t i = 0; i < chunk.count; ++i) {
            uint32_t rays = 0;
            for (uint32_t k = first[i]; k < first[i + 1]; ++k) rays += gpu::seenRays(seen[k]);
            f(faces[i] / 6, rays);
        }
    }
}

TEST(GatherClusters, KeepTheEnergyOfAFurnace) {
    // Walls that emit e and reflect a: direct irradiance is pi e, and after n bounces between clusters and
    // one of the gather pi e (a + ... + a^(n + 1)) is indirect. Rays of a closed box all meet a wall.
    for (const auto& [near, direct] :
         {std::pair<std::string, std::string>{"0", "injected"}, {"4", "injected"}, {"4", "shadow_rays"}})
        for (const int bounces : {0, 4}) {
            const double a = 0.7, expected = a * a * (1 - std::pow(a, bounces + 1)) / (1 - a);
            Chain chain(
                "furnace", "{shape: box, albedo: 0.7, emission: 1}",
                graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64, near_distance: " + near,
                                       std::to_string(bounces) + ", direct: " + direct, "filter_passes: 0")));
            // All that is seen from within the box, and nothing from without.
            const auto sides = readSides(chain);
            uint32_t inside = 0, outside = 0;
            forEachPatch(chain, [&](uint32_t side, uint32_t rays) {
                const glm::vec3 at = glm::abs(sides[side].raised);
                const bool isInside = std::max({at.x, at.y, at.z}) < 1;
                EXPECT_EQ(rays, isInside ? 64 : 0) << "side " << side;
                ++(isInside ? inside : outside);
            });
            EXPECT_GT(inside, 1000);
            EXPECT_GT(outside, 1000);
            const double ratio = mean(chain.image("indirect")) / expected;
            std::printf("near %s, %s, %d bounces: %.4f of the closed form\n", near.c_str(), direct.c_str(),
                        bounces, ratio);
            EXPECT_NEAR(ratio, 1, 0.01);
        }
}

TEST(InjectClusters, KeepTheFluxOfALampInAGapNarrowerThanAVoxel) {
    // A lamp of I W/sr amid a closed box of 24 m² in one voxel: within it no side is open. 4 pi I / 24 m²
    // arrives at each wall, and a of it again with each bounce. Nothing arrives at the open, outer sides.
    const double a = 0.5, intensity = 2, first = 4 * kPi * intensity / 24;
    const double sent = a * first * (1 - std::pow(a, 5)) / (1 - a);
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                graphYaml({"voxelize, resolution: 1", "place_surfels, sides: all, points_per_voxel: 256",
                           "cluster_voxels, target: 1", "find_patches", "cluster_visibility, rays: 256",
                           "inject_clusters, bounces: 4, direct: shadow_rays"}));
    const auto sides = readSides(chain);
    const auto light = chain.read<float>(chain.graph().resource<ClusterLight>("cluster_light")->sides);
    const auto materials =
        chain.read<gpu::PackedVoxelMaterial>(chain.graph().resource<VoxelPatches>("patches")->materials);
    const float voxelSize = chain.graph().resource<SurfaceVoxels>("voxels")->grid.voxelSize;
    double flux = 0, area = 0, outside = 0;
    for (size_t side = 0; side < sides.size(); ++side) {
        const gpu::VoxelMaterial m = gpu::unpackMaterial(materials[side]);
        for (int face = 0; face < 6; ++face) {
            const double own = light[(6 * side + size_t(face)) * 3 + 1];
            if (sides[side].isCovered == 0) {
                outside += own;
                continue;
            }
            const glm::vec3& areas = face % 2 == 0 ? m.unoccludedPositive : m.unoccludedNegative;
            area += areas[face / 2] * voxelSize * voxelSize;
            flux += own * areas[face / 2] * voxelSize * voxelSize;
        }
    }
    std::printf("a gap: %.4f of its area, %.4f of the flux\n", area / 24, flux / area / sent);
    EXPECT_NEAR(area / 24, 1, 0.01);
    EXPECT_NEAR(flux / area / sent, 1, 0.03);
    EXPECT_EQ(outside, 0);
}

TEST(GatherClusters, KeepTheEnergyOfASphere) {
    // Its walls are sheets at all angles to the voxels, whose dark outer faces must not be seen from within.
    // About the axis of a face a hemisphere reaches behind a slanted sheet and loses light.
    const auto ratio = [](const std::string& hemisphere) {
        Chain chain("furnace", "{shape: sphere, albedo: 0.7, emission: 1}",
                    graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64, hemisphere: " + hemisphere, "1",
                                           "filter_passes: 0")));
        return mean(chain.image("indirect")) / (0.7 * (0.7 + 0.7 * 0.7));
    };
    const double surface = ratio("surface"), face = ratio("face");
    std::printf("sphere: %.4f of the closed form, about faces' axes %.4f\n", surface, face);
    EXPECT_NEAR(surface, 1, 0.01);
    EXPECT_LT(face, 0.97);
}

TEST(GatherClusters, SendNoMoreFromSliversThanFromTheirClusters) {
    // Irradiance is pi everywhere in a sphere that emits 1. Corners of voxels that it cuts off have next to
    // no area, over which a few rays would be anything.
    Chain chain("furnace", "{shape: sphere, albedo: 0.5, emission: 1}",
                graphYaml(clusterGraph("rays_per_light: 1048576, bounces: 0", "target: 200", "rays: 1", "0",
                                       "filter_passes: 0", "32")));
    double brightest = 0;
    for (const float radiosity :
         chain.read<float>(chain.graph().resource<ClusterLight>("cluster_light")->sides))
        brightest = std::max(brightest, double(radiosity) / (0.5 * kPi));
    std::printf("brightest face: %.2f of the closed form\n", brightest);
    EXPECT_GT(brightest, 1);
    EXPECT_LT(brightest, 2);
}

TEST(GatherClusters, KeepTheFluxOfALamp) {
    // A point light of I W/sr in a closed room: 4 pi I arrives, and a of it again with each bounce.
    // Rays begin half a voxel off the walls, so that a room of n voxels seems to be one or two smaller.
    for (const int resolution : {24, 48}) {
        Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                    graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64", "2", "filter_passes: 2",
                                           std::to_string(resolution))));
        const double ratio = indirectFlux(chain) / (4 * kPi * 2 * (0.5 + 0.25 + 0.125));
        std::printf("%d voxels: %.4f of the flux\n", resolution, ratio);
        EXPECT_NEAR(ratio, 1, 1.0 / resolution);
    }
}

TEST(GatherClusters, AreLinearInLightAndTheSameTwice) {
    const auto run = [](const std::string& intensity) {
        Chain chain("white_room", "{intensity: " + intensity + "}",
                    graphYaml(clusterGraph(kDirect, "target: 100", "rays: 32", "1", "filter_size: 3")));
        return std::pair{
            chain.read<uint32_t>(chain.graph().resource<VoxelIrradiance>("irradiance")->indirect),
            indirectFlux(chain)};
    };
    const auto [words, flux] = run("2");
    EXPECT_EQ(words, run("2").first);
    EXPECT_NEAR(run("8").second / flux, 4, 1e-3);
}

TEST(GatherClusters, AgreeWithGatheringFromEveryVoxel) {
    // Clusters average over their voxels; the sum of light stays.
    const auto run = [](const std::string& near) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml(clusterGraph(kDirect, "target: 400", "rays: 128, near_distance: " + near, "0",
                                           "filter_passes: 0", "32")));
        return mean(chain.image("indirect"));
    };
    const double voxels = run("10000");
    const double clusters = run("0") / voxels, mixed = run("4") / voxels;
    std::printf("clusters %.4f, near by voxels %.4f of every voxel\n", clusters, mixed);
    EXPECT_NEAR(clusters, 1, 0.03);
    EXPECT_NEAR(mixed, 1, 0.01);
}

TEST(GatherClusters, AgreeWithTheReferenceOnCornell) {
    Chain reference("cornell", "{lights: point}", graphYaml({"path_trace, spp: 512, bounces: 3"}));
    const double expected = mean(reference.image("indirect"));
    for (const std::string visibility : {"voxels", "exact", "bresenham"}) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml(clusterGraph(kDirect, "target: 800", "rays: 128, visibility: " + visibility,
                                           "2", "filter_passes: 2, filter_size: 3", "48")));
        const double ratio = mean(chain.image("indirect")) / expected;
        std::printf("%s: %.4f of the reference\n", visibility.c_str(), ratio);
        EXPECT_NEAR(ratio, 1, 0.05) << visibility;
    }
}

TEST(ClusterVisibility, CountsFormFactors) {
    // Parallel unit squares, 1 m apart: F = 0.19982 (Howell, C-11). Of what each voxel's face that looks up
    // from the lower one sees, rays that meet the upper one.
    for (const std::string visibility : {"voxels", "exact"}) {
        Chain chain("quad_light", "{}",
                    graphYaml({"voxelize, resolution: 32", "cluster_voxels, target: 100", "place_surfels",
                               "find_patches",
                               "cluster_visibility, rays: 256, near_distance: 0, visibility: " + visibility}),
                    16, 16);
        const Clusters c(chain);
        const auto* patches = chain.graph().resource<VoxelPatches>("patches");
        const auto sides = chain.read<gpu::SurfaceSide>(patches->sides);
        const auto parts = chain.read<gpu::ClusterPart>(patches->parts);
        const auto members = chain.read<uint32_t>(patches->members);
        const auto materials = chain.read<gpu::PackedVoxelMaterial>(patches->materials);
        const auto* lists = chain.graph().resource<ClusterVisibility>("cluster_visibility");
        double sum = 0, area = 0;
        for (const ClusterVisibility::Chunk& chunk : lists->chunks) {
            const auto faces = chain.read<uint32_t>(chunk.faces), first = chain.read<uint32_t>(chunk.first);
            const auto seen = chain.read<uint32_t>(chunk.seen);
            for (uint32_t i = 0; i < chunk.count; ++i) {
                const uint32_t side = faces[i] / 6;
                if (faces[i] % 6 != 2 || c.coordinates[sides[side].voxel].y > 16) continue;
                const double own = gpu::unpackMaterial(materials[side]).unoccludedPositive.y;
                area += own;
                for (uint32_t k = first[i]; k < first[i + 1]; ++k)
                    if (sides[members[parts[gpu::seenTarget(seen[k]) / 6].firstMember]].raised.y > 0.5f)
                        sum += own * gpu::seenRays(seen[k]) / lists->rays;
            }
        }
        std::printf("%s: form factor %.4f\n", visibility.c_str(), sum / area);
        // Through voxels rays begin one of 1/32 m above the square and end one before the other.
        EXPECT_NEAR(sum / area, 0.19982, visibility == "exact" ? 0.002 : 0.02);
    }
}

/// Light of sides inside a sealed room whose floor and ceiling run on outside, into the sun, through the same
/// voxels, next to that of all others: means of radiosity, green.
double leakIntoARoom(const std::string& visibility, const std::string& direct, const std::string& near) {
    Chain chain("shell_room", "{wall_thickness: 0.1}",
                graphYaml(clusterGraph("rays_per_light: 262144, bounces: 0", "target: 400",
                                       "rays: 64, near_distance: " + near + ", visibility: " + visibility,
                                       "2, direct: " + direct, "filter_passes: 2", "25")));
    const auto sides = readSides(chain);
    const auto light = chain.read<float>(chain.graph().resource<ClusterLight>("cluster_light")->sides);
    double inside = 0, outside = 0, insideCount = 0, outsideCount = 0;
    for (size_t i = 0; i < sides.size(); ++i) {
        double sum = 0;
        for (size_t face = 0; face < 6; ++face) sum += light[(6 * i + face) * 3 + 1];
        const glm::vec3 at = sides[i].raised;
        const bool isInside = std::abs(at.x) < 2 && at.y > 0 && at.y < 2.5f && std::abs(at.z) < 2;
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
    // What injected light and rays through voxels do there.
    EXPECT_GT(leakIntoARoom("exact", "injected", "4"), 0.01);
    EXPECT_GT(leakIntoARoom("voxels", "shadow_rays", "4"), 0.01);
}

TEST(ClusterVisibility, LookAlongTheNormalOfEachWallOfACorner) {
    // Voxels hold one mean normal. Where walls across axes meet, the patches before each look along its axis
    // alone, whatever part of the area each has: the same light by both hemispheres. Furniture that stands
    // at an angle has other light by its faces' axes.
    struct Light {
        std::vector<float> flux;      ///< By voxel and face, 3 floats each.
        std::vector<uint32_t> ways;   ///< By voxel: a bit for each face that one of its surfels looks along.
        std::vector<bool> isAligned;  ///< By voxel: whether all of its surfels look along axes.
    };
    const auto lightOf = [](const std::string& hemisphere) {
        Chain chain("clutter", "{}",
                    graphYaml(clusterGraph(kDirect, "target: 100", "rays: 64, hemisphere: " + hemisphere, "0",
                                           "filter_passes: 0", "19")));
        Light light;
        light.flux = readFlux(chain, chain.graph().resource<VoxelIrradiance>("irradiance")->indirect);
        const auto surfels =
            chain.read<gpu::PatchSurfel>(chain.graph().resource<VoxelPatches>("patches")->surfels);
        light.ways.resize(light.flux.size() / 18);
        light.isAligned.resize(light.ways.size(), true);
        for (const gpu::PatchSurfel& s : surfels)
            for (int axis = 0; axis < 3; ++axis) {
                const float along = s.normal[axis];
                if (std::abs(along) > 0.999f)
                    light.ways[s.voxel] |= 1u << (2 * axis + (along < 0 ? 1 : 0));
                else if (std::abs(along) > 0.001f)
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
        if (i % 18 == 0 && isAligned && std::popcount(face.ways[i / 18]) > 1) ++corners;
    }
    std::printf("%.0f corners: %.6f of the light differs, at slanted surfaces %.4f\n", corners,
                difference[1] / sum[1], difference[0] / sum[0]);
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
    EXPECT_CONTAINS(
        errorOf([] {
            Chain("cornell", "{lights: point}",
                  graphYaml(clusterGraph(kDirect, "target: 50", "rays: 16", "0", "filter_size: 3", "1")));
        }),
        "no light falls on any voxel");
    EXPECT_CONTAINS(errorOf([] {
                        Chain("cornell", "{lights: point}",
                              graphYaml({"voxelize, resolution: 16, visibility_rays: 0", "place_surfels",
                                         "cluster_voxels", "find_patches"}));
                    }),
                    "find_patches");
}

}  // namespace
}  // namespace voxray::test

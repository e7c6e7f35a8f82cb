// Cones that see by rays, the residual of cones, and the comparison of both.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/shapes.h"
#include "tests/gpu/mean_of_frames.h"
#include "tests/support/errors.h"
#include "tests/support/radiance_layouts.h"

namespace voxray::test {
namespace {

std::string graphOf(const std::string& gather, const std::string& resolution = "32",
                    const std::string& inject = "rays_per_light: 131072, bounces: 3",
                    const std::string& filter = "layout: svo", const std::string& samples = "1") {
    return graphYaml({"gbuffer, samples_per_pixel_edge: " + samples, "voxelize, resolution: " + resolution,
                      "inject_light_rays, " + inject, "filter_voxels, " + filter, gather});
}

TEST(ConeRays, KeepTheEnergyOfAFurnace) {
    // Surfaces emit 1 and reflect 0.5: after two bounces voxels hold 1 + 0.5 + 0.25 + 0.125
    const auto part = [](const std::string& shape, const std::string& layout) {
        return meanIndirect("furnace", "{shape: " + shape + ", albedo: 0.5, emission: 1}",
                            graphOf("gather_cones, visibility: rays", "32", "rays_per_light: 65536, bounces: 2",
                                    "emission: true, layout: " + layout)) /
               (0.5 * 1.875);
    };
    for (const TestedLayout& layout : kRadianceLayouts)
        for (const std::string shape : {"box", "sphere"})
            EXPECT_NEAR(part(shape, layout.filter), 1.0, 0.01) << layout.filter << shape;
}

TEST(ConeRays, SeeNothingThroughThinWalls) {
    // Two sealed rooms, a light in one. Voxels of 13 cm, walls of 5 cm
    const auto leak = [](const std::string& gather) {
        const auto seen = [&](const std::string& view) {
            return meanIndirect("thin_wall", "{thickness: 0.05, view: " + view + "}", graphOf(gather));
        };
        return seen("dark") / seen("lit");
    };
    const double voxels = leak("gather_cones, visibility: voxels"), rays = leak("gather_cones, visibility: rays");
    std::printf("leak through a thin wall: voxels %.5f, rays %.5f\n", voxels, rays);
    EXPECT_LT(rays, 0.5 * voxels);
    EXPECT_LT(rays, 0.002);
}

TEST(ConeRays, AreRightInARoomLitThroughAWindow) {
    const std::string scene = "window_room", parameters = "{slats: 0}";
    const double expected = mean(pathTraced(scene, parameters, 1024, 4));
    const auto ratio = [&](const std::string& gather) {
        return meanIndirect(scene, parameters,
                            graphOf(gather, "64", "rays_per_light: 2097152, bounces: 3", "layout: svo", "4")) /
               expected;
    };
    const double voxels = ratio("gather_cones, visibility: voxels"), rays = ratio("gather_cones, visibility: rays");
    std::printf("window_room: voxels %.4f, rays %.4f of the reference\n", voxels, rays);
    EXPECT_NEAR(rays, 1, 0.03);
    EXPECT_GT(std::abs(voxels - 1), std::abs(rays - 1));
}

Estimate meanOfFrames(const State& state, const std::string& graph, int frames) {
    Chain chain(state, graph, 32, 32);
    return meanOfFrames(chain, frames);
}

TEST(ConeRays, WithAResidualTheMeanIsTheReferencesWhateverIsStored) {
    for (const std::string name : {"cornell", "window_room"}) {
        const State state = builtin(name, name == "cornell" ? "{lights: area}" : "{slats: 0}");
        const Estimate reference = meanOfFrames(state, graphYaml({"path_trace, spp: 512, bounces: 4"}), 8);
        const auto compare = [&](const std::string& gather, const std::string& bounces) {
            const Estimate found =
                meanOfFrames(state,
                             graphOf("gather_cones, cones: 16, stride: 4, " + gather, "16",
                                     "rays_per_light: 65536, bounces: " + bounces, "layout: svo", "8"),
                             16);
            const double ratio = found.mean / reference.mean,
                         error = std::sqrt(found.variance + reference.variance) / reference.mean;
            std::printf("%s, %s, %s bounces stored: %.4f +- %.4f of the reference\n", name.c_str(), gather.c_str(),
                        bounces.c_str(), ratio, error);
            return std::pair{ratio, error};
        };
        for (const std::string visibility : {"voxels", "rays"})
            for (const std::string bounces : {"0", "3"}) {
                const auto [ratio, error] =
                    compare("visibility: " + visibility + ", residual: 0.3, residual_bounces: 4", bounces);
                EXPECT_NEAR(ratio, 1, 0.01 + 2 * error) << name << visibility << bounces;
            }
        const auto [ratio, error] =
            compare("visibility: rays, near_field_voxels: 2, residual: 1, residual_bounces: 4", "0");
        EXPECT_NEAR(ratio, 1, 0.01 + 2 * error) << name;
        // The same comparison finds that stored light alone lacks bounces
        EXPECT_GT(std::abs(compare("visibility: rays", "0").first - 1), 0.1) << name;
    }
}

TEST(ConeRays, AFilterOfTheResidualKeepsItsMeanAndTakesItsNoise) {
    const State state = builtin("cornell", "{lights: area}");
    const Estimate reference = meanOfFrames(state, graphYaml({"path_trace, spp: 512, bounces: 4"}), 8);
    struct Found {
        double ratio, error, noise;
    };
    const auto measure = [&](const std::string& stride, const std::string& filter,
                             const std::vector<std::string>& after) {
        std::vector<std::string> passes{
            "gbuffer, samples_per_pixel_edge: 4", "voxelize, resolution: 16",
            "inject_light_rays, rays_per_light: 65536, bounces: 0", "filter_voxels",
            "gather_cones, specular: 0, residual: 0.3, residual_bounces: 4, residual_filter: " + filter +
                ", stride: " + stride};
        passes.insert(passes.end(), after.begin(), after.end());
        Chain chain(state, graphYaml(passes), 32, 32);
        const Estimate found = meanOfFrames(chain, 12);
        const ImageF last = chain.image("indirect");
        chain.runFrame(13);
        const ImageF next = chain.image("indirect");
        double squares = 0;
        for (size_t i = 0; i < last.data.size(); ++i) squares += std::pow(double(next.data[i]) - last.data[i], 2);
        return Found{found.mean / reference.mean, std::sqrt(found.variance + reference.variance) / reference.mean,
                     std::sqrt(squares / double(last.data.size())) / reference.mean};
    };
    for (const std::string stride : {"1", "4"}) {
        const Found averaged = measure(stride, "mean", {}),
                    filtered = measure(stride, "apart", {"filter_irradiance, light: residual"});
        std::printf("stride %s: mean %.4f +- %.4f, difference of two frames %.3f; filtered apart %.4f +- %.4f, %.3f\n",
                    stride.c_str(), averaged.ratio, averaged.error, averaged.noise, filtered.ratio, filtered.error,
                    filtered.noise);
        EXPECT_NEAR(filtered.ratio, 1, 0.02 + 2 * filtered.error) << stride;
        EXPECT_LT(filtered.noise, 0.6 * averaged.noise) << stride;
    }
}

// A floor of shallow ridges, whose bright sides face a lit wall and whose dark sides face away: albedo and irradiance
// change together within the mean over texels.
State ridges() {
    SceneBuilder builder("ridges");
    const uint32_t bright = builder.lambert("bright", glm::vec3(0.8f)), dark = builder.lambert("dark", glm::vec3(0.1f));
    constexpr int kRidges = 48;
    const float width = 2.0f / kRidges, height = 0.15f * width;
    for (int i = 0; i < kRidges; ++i) {
        const float x = -1 + float(i) * width;
        builder.quad("bright side", {x, 0, 1}, {0.5f * width, height, 0}, {0, 0, -2}, bright);
        builder.quad("dark side", {x + 0.5f * width, height, 1}, {0.5f * width, -height, 0}, {0, 0, -2}, dark);
    }
    builder.quad("wall", {-1.2f, 0, -1}, {0, 1, 0}, {0, 0, 2}, bright);
    builder.pointLight({-0.9f, 0.5f, 0}, glm::vec3(1));
    builder.camera({0, 2.5f, 0.01f}, {0, 0, 0}, 40);
    return evaluated(builder);
}

TEST(ConeRays, GiveBackWhatTheMeanOverTexelsLoses) {
    const State state = ridges();
    const Estimate reference = meanOfFrames(state, graphYaml({"path_trace, spp: 512, bounces: 2"}), 4);
    const Estimate found = meanOfFrames(state,
                                        graphOf("gather_cones, residual: 1, residual_bounces: 2, stride: 4", "32",
                                                "rays_per_light: 65536, bounces: 1", "layout: svo", "8"),
                                        8);
    const double ratio = found.mean / reference.mean,
                 error = std::sqrt(found.variance + reference.variance) / reference.mean;
    std::printf("ridges: %.4f +- %.4f of the reference\n", ratio, error);
    EXPECT_NEAR(ratio, 1, 0.01 + 2 * error);
}

TEST(ConeRays, TheResidualOfGlossySurfacesIsNotFilteredApart) {
    EXPECT_THROW(meanIndirect("cornell", "{}",
                              graphYaml({"gbuffer", "voxelize, resolution: 16", "inject_light_rays", "filter_voxels",
                                         "gather_cones, residual: 0.5, residual_filter: apart",
                                         "filter_irradiance, light: residual"})),
                 Error);
}

TEST(ConeRays, GoOnAsPathsWithTheirProbability) {
    const State state = builtin("cornell", "{lights: area}");
    const auto paths = [&](const std::string& p) {
        Chain chain(state, graphOf("gather_cones, residual: " + p), 32, 32);
        return reported(chain.frameSamples.back(), "paths, % of cones") / 100;
    };
    const double all = paths("1");
    EXPECT_GT(all, 0.5);
    for (const std::string p : {"0.1", "0.5"}) EXPECT_NEAR(paths(p) / all, std::stod(p), 0.01) << p;
}

TEST(ConeRays, AreDeterministic) {
    for (const std::string gather : {"visibility: rays", "visibility: rays, near_field_voxels: 2, residual: 0.3"}) {
        const auto run = [&] {
            return indirectLight("cornell", "{lights: point}", graphOf("gather_cones, " + gather)).data;
        };
        EXPECT_EQ(run(), run()) << gather;
    }
}

TEST(ConeRays, AResidualWantsNoEmission) {
    EXPECT_THROW(
        meanIndirect("cornell", "{}", graphOf("gather_cones, residual: 0.5", "32", "bounces: 1", "emission: true")),
        Error);
}

TEST(CompareCones, FindsNoDifferenceWhereAllSurfacesSendTheSame) {
    Chain chain("furnace", "{shape: box, albedo: 0.5, emission: 1}",
                graphOf("compare_cones, stride: 4", "32", "rays_per_light: 262144, bounces: 2", "emission: true"));
    const auto value = [&](const std::string& name) { return reported(chain.frameSamples.back(), name); };
    EXPECT_NEAR(value("cones"), 1, 0.01);
    EXPECT_NEAR(value("rays, read as wide as the cone"), 1, 0.01);
    for (const std::string level : {"0", "1", "2"}) EXPECT_NEAR(value("rays, read in level " + level), 1, 0.01);
    EXPECT_NEAR(value("opacity lacking behind it"), 0, 0.01);
    double parts = 0, levels = 0;
    for (const char* part : {"within 2 voxels of the start", "before the ray's hit", "at the ray's hit",
                             "behind the ray's hit", "where the ray hits nothing"})
        parts += value(std::string("cones, ") + part);
    for (int level = 0; level < 8; ++level) levels += value("cones, taken in level " + std::to_string(level));
    EXPECT_NEAR(parts, value("cones"), 1e-4);
    EXPECT_NEAR(levels, value("cones"), 1e-4);
}

TEST(CompareCones, FindsWhatConesMissAndTakeElsewhere) {
    Chain chain("window_room", "{slats: 0}",
                graphOf("compare_cones, stride: 4", "64", "rays_per_light: 2097152, bounces: 3"));
    const auto value = [&](const std::string& name) { return reported(chain.frameSamples.back(), name); };
    EXPECT_GT(std::abs(value("cones") - 1), 0.03);
    EXPECT_GT(value("rays, read in level 3"), 1.5);  // Sunlit ground and dark room share voxels
}

}  // namespace
}  // namespace voxray::test

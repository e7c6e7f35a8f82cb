// Cone tracing: energy, linearity, leaks.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gpu/chain.h"
#include "tests/support/errors.h"
#include "tests/support/radiance_layouts.h"

namespace voxray::test {
namespace {

struct Setting {
    std::string gbuffer = "samples_per_pixel_edge: 1";
    std::string voxelize = "resolution: 32";
    std::string inject = "rays_per_light: 131072, bounces: 3";
    std::string filter = "emission: false";
    std::string gather = "cones: 16";
};

std::string coneGraph(const Setting& s) {
    return graphYaml({"gbuffer, " + s.gbuffer, "voxelize, " + s.voxelize, "inject_light_rays, " + s.inject,
                      "filter_voxels, " + s.filter, "gather_cones, visibility: voxels, " + s.gather});
}

double indirect(const std::string& scene, const std::string& parameters, const Setting& setting) {
    return meanIndirect(scene, parameters, coneGraph(setting));
}

/// Indirect light in the room without light, relative to the one with.
double leak(const std::string& thickness, const Setting& setting) {
    const auto seen = [&](const std::string& view) {
        return indirect("thin_wall", "{thickness: " + thickness + ", view: " + view + "}", setting);
    };
    return seen("dark") / seen("lit");
}

const std::vector<std::string> kSets = {"5", "6", "16", "36"};

/// A closed room whose surfaces emit 1 and reflect 0.5: what cones find of the light, over the closed form.
/// After two bounces voxels hold 1 + 0.5 + 0.25 + 0.125.
double furnacePart(const std::string& shape, const std::string& layout, const std::string& cones,
                   const std::string& resolution = "32") {
    Setting s;
    s.voxelize = "resolution: " + resolution;
    s.inject = "rays_per_light: 65536, bounces: 2";
    s.filter = "emission: true, layout: " + layout;
    s.gather = "cones: " + cones;
    return indirect("furnace", "{shape: " + shape + ", albedo: 0.5, emission: 1}", s) / (0.5 * 1.875);
}

TEST(ConeTracing, EverySetKeepsTheEnergyOfAFurnace) {
    for (const std::string& cones : kSets) {
        EXPECT_NEAR(furnacePart("box", "dense", cones), 1.0, 0.01) << cones;
        // Curved walls: all angles to the axes, concave everywhere.
        EXPECT_NEAR(furnacePart("sphere", "dense", cones), 1.0, 0.03) << cones;
    }
}

TEST(ConeTracing, EveryLayoutKeepsTheEnergyOfACurvedFurnace) {
    for (const TestedLayout& layout : kRadianceLayouts) {
        if (layout.followsCamera) continue;
        EXPECT_NEAR(furnacePart("sphere", layout.filter, "6"), 1.0, 0.03) << layout.filter;
    }
    // Windows half as long as the sphere is wide.
    EXPECT_NEAR(furnacePart("sphere", "clipmap, clipmap_resolution: 32", "6", "64"), 1.0, 0.03);
}

TEST(ConeTracing, SteppedConesAsPublishedAreLinearAndKeepNoEnergy) {
    // Where every surface sends the same, what is missing to 1 is opacity that a march in free steps lost, or
    // that a surface's own voxels took: with a value for each direction its dark back hides most of the room.
    const auto part = [](const std::string& layout, const std::string& directions, const std::string& emission) {
        return meanIndirect("furnace", "{shape: box, albedo: 0.5, emission: " + emission + "}",
                            graphYaml({"gbuffer", "voxelize, resolution: 32, directions: " + directions,
                                       "inject_light_rays, rays_per_light: 65536, bounces: 2",
                                       "filter_voxels, emission: true, layout: " + layout, "gather_stepped_cones"})) /
               (0.5 * 1.875);
    };
    const double one = part("dense", "1", "1"), six = part("dense", "6", "1");
    std::printf("stepped cones: %.4f of the closed form by one direction, %.4f by six\n", one, six);
    EXPECT_GT(one, 0.25);
    EXPECT_LT(one, 1);
    EXPECT_GT(six, 0);
    EXPECT_LT(six, 1);
    EXPECT_NEAR(part("svo", "1", "1") / one, 1, 0.02);
    EXPECT_NEAR(part("dense", "1", "8") / one, 8, 0.01);
}

TEST(ConeTracing, ANearFieldByRaysKeepsTheEnergyOfAFurnace) {
    // After eight bounces 0.996 of all that there is. Emission is direct light, unless voxels hold it.
    const auto part = [](const std::string& shape, const std::string& layout, const std::string& voxels,
                         bool emission = false) {
        Setting s;
        s.inject = "rays_per_light: 65536, bounces: 7";
        s.filter = std::string("emission: ") + (emission ? "true" : "false") + ", layout: " + layout;
        s.gather = "cones: 16, near_field_voxels: " + voxels;
        return indirect("furnace", "{shape: " + shape + ", albedo: 0.5, emission: 1}", s) / (emission ? 1 : 0.5);
    };
    for (const TestedLayout& layout : kRadianceLayouts)
        for (const std::string voxels : {"2", "8"}) {
            if (layout.followsCamera) continue;
            EXPECT_NEAR(part("box", layout.filter, voxels), 1.0, 0.02) << layout.filter << voxels;
            EXPECT_NEAR(part("sphere", layout.filter, voxels), 1.0, 0.03) << layout.filter << voxels;
        }
    // Without emission at near hits it would be 0.75 of the near light, with lamps at both ends 1.25.
    EXPECT_NEAR(part("box", "dense", "8", true), 1.0, 0.02);
    EXPECT_NEAR(part("sphere", "dense", "8", true), 1.0, 0.03);
    EXPECT_NEAR(part("sphere", "clipmap, clipmap_resolution: 32", "2"), 1.0, 0.03);
}

TEST(ConeTracing, ANearFieldOfEmissionRefusesLightsThatItCanNotTellApart) {
    const auto scene = builtinScene("cornell");  // Its lamp is a surface
    for (int i = 0; i < 65; ++i) scene->lights.emplace_back().position.y = 0.01f * float(i);
    Setting s;
    s.filter = "emission: true";
    s.gather = "near_field_voxels: 2";
    EXPECT_ERROR("more than 64 point and spot lights", Chain(evaluated(scene), coneGraph(s), 8, 8));
}

TEST(ConeTracing, WallsLeakLittle) {
    // Two sealed rooms side by side, a light in one: nothing arrives in the other. Voxels of 6 and 3 cm.
    Setting s;
    s.voxelize = "resolution: 64";
    for (const std::string thickness : {"0.05", "0.2"}) EXPECT_LT(leak(thickness, s), 0.005) << thickness;
    s.gather = "cones: 16, near_field_voxels: 2";
    EXPECT_LT(leak("0.05", s), 0.005);
    s.gather = "cones: 16";
    s.voxelize = "resolution: 128";
    EXPECT_LT(leak("0.05", s), 0.005);
}

TEST(ConeTracing, EverySetKeepsTheEnergyOfAWhiteRoom) {
    const double expected = mean(pathTraced("white_room", "{albedo: 0.5}", 256, 4));
    for (const std::string& cones : kSets) {
        Setting s;
        s.gather = "cones: " + cones;
        EXPECT_NEAR(indirect("white_room", "{albedo: 0.5}", s) / expected, 1.0, 0.03) << cones;
    }
}

TEST(ConeTracing, IsLinearInLight) {
    const Setting s;
    // Radiance is kept in half floats, in units of a power of two.
    EXPECT_NEAR(indirect("white_room", "{intensity: 7}", s) / indirect("white_room", "{intensity: 1}", s), 7.0, 0.01);
}

TEST(ConeTracing, IsDeterministic) {
    for (const std::string voxels : {"0", "2"}) {
        Setting s;
        s.gather = "cones: 16, near_field_voxels: " + voxels;
        const auto run = [&] { return indirectLight("cornell", "{lights: point}", coneGraph(s)).data; };
        EXPECT_EQ(run(), run()) << voxels;
    }
}

TEST(ConeTracing, FewerTracedPixelsKeepTheEnergy) {
    const auto run = [](const std::string& stride) {
        Setting s;
        s.gather = "cones: 16, stride: " + stride;
        return indirect("cornell", "{lights: point}", s);
    };
    const double all = run("1");
    for (const std::string stride : {"3", "4", "16"}) EXPECT_NEAR(run(stride) / all, 1.0, 0.03) << stride;
}

TEST(ConeTracing, ConvergesToTheReferenceOnCornell) {
    const ImageF& expected = pathTraced("cornell", "{lights: point}", 512, 4);
    const auto error = [&](const std::string& resolution, const std::string& cones) {
        Setting s;
        s.gbuffer = "samples_per_pixel_edge: 3";
        s.voxelize = "resolution: " + resolution;
        s.inject = "rays_per_light: 524288, bounces: 3";
        s.gather = "cones: " + cones + ", stride: 3";
        const ImageF image = indirectLight("cornell", "{lights: point}", coneGraph(s));
        const double ratio = mean(image) / mean(expected);
        EXPECT_NEAR(ratio, 1.0, 0.03) << resolution << ' ' << cones;  // 0.980 and 0.992, noise 0.3 %.
        const double difference = meanDifference(image, expected);
        std::printf("%s, %s cones: %.4f of the path tracer's, mean difference %.4f\n", resolution.c_str(),
                    cones.c_str(), ratio, difference);
        return difference;
    };
    const double fine = error("64", "16");
    EXPECT_LT(fine, 0.85 * error("16", "5"));
    EXPECT_LT(fine, 0.12);
}

}  // namespace
}  // namespace voxray::test

// Cone tracing: energy, linearity, leaks.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

struct Setting {
    std::string voxelize = "resolution: 32";
    std::string inject = "rays_per_light: 131072, bounces: 3";
    std::string filter = "emission: false";
    std::string gather = "cones: 16";
};

std::string coneGraph(const Setting& s) {
    return "[{pass: gbuffer}, {pass: voxelize, " + s.voxelize + "}, {pass: inject_light_rays, " + s.inject +
           "}, {pass: filter_voxels, " + s.filter + "}, {pass: gather_cones, " + s.gather + "}]";
}

double indirect(const std::string& scene, const std::string& parameters, const Setting& setting) {
    Chain chain(scene, parameters, coneGraph(setting));
    return mean(chain.image("indirect"));
}

/// Indirect light in the room without light, relative to the one with.
double leak(const std::string& thickness, const Setting& setting) {
    const auto seen = [&](const std::string& view) {
        return indirect("thin_wall", "{thickness: " + thickness + ", view: " + view + "}", setting);
    };
    return seen("dark") / seen("lit");
}

const std::vector<std::string> kSets = {"5", "6", "16", "36"};

TEST(ConeTracing, EverySetKeepsTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.5: after two bounces in the voxels cones see 1 + 0.5 + 0.25 + 0.125.
    for (const std::string shape : {"box", "sphere"})
        for (const std::string& cones : kSets) {
            Setting s;
            s.inject = "rays_per_light: 262144, bounces: 2";
            s.filter = "emission: true";
            s.gather = "cones: " + cones;
            std::printf("%s %s %.4f\n", shape.c_str(), cones.c_str(), indirect("furnace", "{shape: " + shape + ", albedo: 0.5, emission: 1}", s)/(.5*1.875));
        }
}

TEST(ConeTracing, WallsLeakLittle) {
    // Two sealed rooms side by side, a light in one: nothing arrives in the other. Voxels of 6 cm.
    Setting s;
    s.voxelize = "resolution: 64";
    for (const std::string thickness : {"0.05", "0.2"}) EXPECT_LT(leak(thickness, s), 0.01) << thickness;
}

TEST(ConeTracing, EverySetKeepsTheEnergyOfAWhiteRoom) {
    Chain reference("white_room", "{albedo: 0.5}", "[{pass: path_trace, spp: 256, bounces: 4}]");
    for (const std::string& cones : kSets) {
        Setting s;
        s.gather = "cones: " + cones;
        std::printf("%s %.4f\n", cones.c_str(), indirect("white_room", "{albedo: 0.5}", s) / mean(reference.image("indirect")));
    }
}

}  // namespace
}  // namespace voxray::test

#include <gtest/gtest.h>

#include <set>

#include "config/sweep.h"

using namespace voxray;

namespace {

std::vector<Variant> expand(const std::string& sweep) {
    return expandSweep(
        parseExperiment("name: demo\n"
                        "scene: {builtin: cornell, lights: area}\n"
                        "graph:\n"
                        "  - {pass: voxelize, resolution: 64}\n"
                        "  - {pass: inject_light_rays, id: inject, write: average}\n"
                        "sweep:\n" +
                            sweep,
                        "demo.yaml"));
}

std::string errorOf(const std::string& sweep) {
    try {
        expand(sweep);
    } catch (const UsageError& error) {
        return error.what();
    }
    return {};
}

}  // namespace

TEST(Sweep, NoAxesGiveOneVariant) {
    const auto variants = expand("  {}\n");
    ASSERT_EQ(variants.size(), 1u);
    EXPECT_EQ(variants[0].name, "default");
}

TEST(Sweep, CartesianProductInFileOrder) {
    const auto variants = expand(
        "  voxelize.resolution: [32, 64]\n"
        "  inject: [inject_light_rays, inject_camera_rays, {pass: inject_rsm, write: max}]\n");
    ASSERT_EQ(variants.size(), 6u);
    EXPECT_EQ(variants[0].name, "resolution-32_inject-inject_light_rays");
    EXPECT_EQ(variants[1].name, "resolution-32_inject-inject_camera_rays");
    EXPECT_EQ(variants[5].name, "resolution-64_inject-inject_rsm");
    EXPECT_EQ(variants[5].values, (std::vector<std::string>{"64", "inject_rsm"}));

    // The swapped pass keeps the id and takes nothing over from the old one
    EXPECT_EQ(variants[5].setup.graph.items[1].text(), "{pass: inject_rsm, write: max, id: inject}");
    EXPECT_EQ(variants[1].setup.graph.items[1].text(), "{pass: inject_camera_rays, id: inject}");
    EXPECT_EQ(variants[5].setup.graph.items[0].find("resolution")->scalar, "64");
}

TEST(Sweep, ParameterReachesSwappedPassWhateverTheOrder) {
    for (const char* sweep : {"  inject.write: [max]\n  inject: [inject_rsm]\n",
                              "  inject: [inject_rsm]\n  inject.write: [max]\n"}) {
        const auto variants = expand(sweep);
        EXPECT_EQ(variants[0].setup.graph.items[1].text(), "{pass: inject_rsm, id: inject, write: max}");
    }
}

TEST(Sweep, ConfigAxes) {
    const auto variants = expand(
        "  image.width: [16, 32]\n  scene.lights: [point, spot]\n  seed: [1, 2]\n"
        "  tracer: [embree, ray_query]\n");
    ASSERT_EQ(variants.size(), 16u);
    EXPECT_EQ(variants[15].setup.image.width, 32u);
    EXPECT_EQ(variants[15].setup.scene.builtinParameters.find("lights")->scalar, "spot");
    EXPECT_EQ(variants[15].setup.general.seed, 2u);
    EXPECT_EQ(variants[15].setup.general.tracer, TracerKind::RayQuery);
}

TEST(Sweep, NamesAreSafeAndUnique) {
    const auto variants = expand(
        "  inject.write: ['a/b', 'a:b', '../x', \"\xc3\xa9\", '']\n"
        "  scene: [{builtin: cornell, lights: area}, {builtin: cornell, lights: spot}]\n");
    std::set<std::string> names;
    for (const Variant& v : variants) {
        EXPECT_TRUE(names.insert(v.name).second) << v.name;
        EXPECT_EQ(v.name.find_first_of("/:\\ "), std::string::npos) << v.name;
        EXPECT_LE(v.name.size(), 140u);
    }
    EXPECT_EQ(names.size(), 10u);
}

TEST(Sweep, Errors) {
    EXPECT_NE(errorOf("  reference.spp: [1, 2]\n").find("demo.yaml:7: sweep: 'reference.spp' is the same"),
              std::string::npos);
    EXPECT_NE(errorOf("  voxelise.resolution: [1]\n").find("did you mean 'voxelize'?"), std::string::npos);
    EXPECT_NE(
        errorOf("  image.widht: [1]\n").find("demo.yaml:7: image: unknown parameter 'widht'; did you mean"),
        std::string::npos);
    EXPECT_NE(errorOf("  voxelize.resolution: [64, 64]\n").find("appears twice"), std::string::npos);
    std::string many = "[0";
    for (int i = 1; i < 200; ++i) many += ", " + std::to_string(i);
    many += "]\n";
    EXPECT_NE(errorOf("  inject.a: " + many + "  inject.b: " + many).find("more than 10000"),
              std::string::npos);
}

// Parameters that lower noise: which of a graph's passes an image takes it from, and that help texts name
// them.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "experiment/study.h"
#include "tests/support/all_passes.h"

using namespace voxray;

namespace {

using Names = std::vector<std::string>;

/// Of the only variant of a graph whose injection has these parameters.
Names noiseOf(const std::string& injection, const std::string& image) {
    const Registry registry = test::allPasses();
    const std::string config =
        "name: x\nscene: {builtin: cornell}\ngraph:\n  - {pass: gbuffer}\n  - {pass: voxelize}\n"
        "  - {pass: place_surfels}\n  - {pass: inject_voxel_rays, id: inject" +
        injection +
        "}\n"
        "  - {pass: trace_gather_rays, id: trace}\n  - {pass: gather_rays}\n"
        "  - {pass: direct_shadow_rays, id: direct}\n  - {pass: composite}\n";
    return makeStudy(parseExperiment(config, "x.yaml"), registry).variants.at(0).graph.noiseParameters(image);
}

}  // namespace

TEST(NoiseParameters, AreThoseOfThePassesThatAnImageDependsOn) {
    const Names indirect{"place_surfels.points_per_voxel", "inject.paths_per_point", "trace.rays_per_block"};
    EXPECT_EQ(noiseOf("", "indirect"), indirect);
    Names final = indirect;
    final.push_back("direct.light_samples");
    EXPECT_EQ(noiseOf("", "final"), final);
    EXPECT_EQ(noiseOf("", "nothing writes it"), Names());
}

TEST(NoiseParameters, AreLeftOutWhereTheyHaveNoEffect) {
    EXPECT_EQ(noiseOf(", bounces: 0", "indirect"), (Names{"place_surfels.points_per_voxel", "trace.rays_per_block"}));
}

TEST(NoiseParameters, StandInTheHelpOfTheirPass) {
    // What makes noise where it is larger
    const std::set<std::string> more{"gather_cones.near_field_voxels", "gather_cones.residual", "inject_rsm.bounces"};
    const std::regex sentence("[Nn]oisy by[^.]*\\.");
    size_t marked = 0;
    const Registry registry = test::allPasses();
    for (const PassKind& kind : registry.kinds()) {
        std::smatch found;
        const std::string said = std::regex_search(kind.help, found, sentence) ? found.str() : "";
        for (const ParameterDoc& parameter : kind.parameters) {
            const std::string path = kind.name + "." + parameter.name;
            const bool isSaid = std::regex_search(said, std::regex("\\b" + parameter.name + "\\b"));
            EXPECT_EQ(parameter.isLessNoise, isSaid && more.count(path) == 0) << path << " in: " << said;
            marked += parameter.isLessNoise;
        }
    }
    EXPECT_GT(marked, 10u);
}

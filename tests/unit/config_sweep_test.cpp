#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/sweep.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

const FilterLabels kFilters{{"accumulate", "accumulated"}, {"filter_irradiance", "filtered"}};

std::vector<SweepPoint> expand(const std::string& sweep) {
    return expandSweep(parseExperiment("name: demo\n"
                                       "scene: {builtin: cornell, lights: area}\n"
                                       "graph:\n"
                                       "  - {pass: voxelize, resolution: 64}\n"
                                       "  - {pass: inject_light_rays, id: inject, write: average}\n"
                                       "sweep:\n" +
                                           sweep,
                                       "demo.yaml"),
                       kFilters);
}

std::string sweepError(const std::string& sweep) {
    return errorOf<UsageError>([&] { expand(sweep); });
}

}  // namespace

TEST(Sweep, NoAxesGiveOneVariant) {
    const auto variants = expand("");
    ASSERT_EQ(variants.size(), 1u);
    EXPECT_EQ(variants[0].name, "default");
    EXPECT_CONTAINS(sweepError("  {}\n"), "an empty map varies nothing");
}

TEST(Sweep, CartesianProductInFileOrder) {
    const auto variants = expand(
        "  voxelize.resolution: [32, 64]\n"
        "  inject: [inject_light_rays, inject_camera_rays, {pass: inject_rsm, write: max}]\n");
    ASSERT_EQ(variants.size(), 6u);
    EXPECT_EQ(variants[0].name, "resolution 32, inject_light_rays");
    EXPECT_EQ(variants[1].name, "resolution 32, inject_camera_rays");
    EXPECT_EQ(variants[5].name, "resolution 64, inject_rsm");
    EXPECT_EQ(variants[5].id, "resolution-64-inject_rsm");
    EXPECT_EQ(variants[5].values, (std::vector<std::string>{"64", "inject_rsm"}));

    // The swapped pass keeps the id and takes nothing over from the old one
    EXPECT_EQ(variants[5].setup.graph.items[1].text(), "{pass: inject_rsm, write: max, id: inject}");
    EXPECT_EQ(variants[1].setup.graph.items[1].text(), "{pass: inject_camera_rays, id: inject}");
    EXPECT_EQ(variants[5].setup.graph.items[0].find("resolution")->scalar, "64");
}

TEST(Sweep, ParameterReachesSwappedPassWhateverTheOrder) {
    for (const char* sweep :
         {"  inject.write: [max]\n  inject: [inject_rsm]\n", "  inject: [inject_rsm]\n  inject.write: [max]\n"}) {
        const auto variants = expand(sweep);
        EXPECT_EQ(variants[0].setup.graph.items[1].text(), "{pass: inject_rsm, id: inject, write: max}");
    }
}

TEST(Sweep, ChainReplacesOnePassAndItsLastKeepsTheId) {
    const auto variants = expand(
        "  inject: [inject_rsm, [place_surfels, {pass: inject_voxel_rays, id: inject, paths_per_point: 4}]]\n"
        "  inject.write: [max]\n");
    ASSERT_EQ(variants.size(), 2u);
    EXPECT_EQ(variants[0].setup.graph.items.size(), 2u);
    EXPECT_EQ(variants[1].setup.graph.text(),
              "[{pass: voxelize, resolution: 64}, {pass: place_surfels}, {pass: inject_voxel_rays, id: "
              "inject, paths_per_point: 4, write: max}]");
    EXPECT_EQ(variants[1].name, "inject_voxel_rays, write max");

    EXPECT_CONTAINS(sweepError("  inject: [[a, {pass: b, id: x}]]\n"),
                    "demo.yaml:7: inject: the last pass of the chain");
    EXPECT_CONTAINS(sweepError("  inject: [{pass: b, id: x}]\n"), "leave out its own id, 'x'");
    EXPECT_CONTAINS(sweepError("  inject: [[]]\n"), "demo.yaml:7: inject: ");
    EXPECT_CONTAINS(sweepError("  inject: [[[a]]]\n"), "demo.yaml:7: inject: ");
    EXPECT_CONTAINS(sweepError("  inject: [[{id: a}, b]]\n"), "demo.yaml:7: inject: ");
    EXPECT_CONTAINS(sweepError("  inject: [[{pass: a, id: image}, b]]\n"), "demo.yaml:7: graph: ");
}

TEST(Sweep, AParameterOfAChainsPassVariesVariantsThatHaveIt) {
    const auto variants = expand(
        "  inject: [inject_rsm, [place_surfels, inject_voxel_rays]]\n"
        "  place_surfels.count: [10, 20]\n"
        "  voxelize.resolution: [32, 64]\n");
    std::vector<std::string> names;
    for (const SweepPoint& variant : variants) names.push_back(variant.name);
    EXPECT_EQ(names, (std::vector<std::string>{
                         "inject_rsm, resolution 32", "inject_rsm, resolution 64",
                         "inject_voxel_rays, count 10, resolution 32", "inject_voxel_rays, count 10, resolution 64",
                         "inject_voxel_rays, count 20, resolution 32", "inject_voxel_rays, count 20, resolution 64"}));
    EXPECT_EQ(variants[0].values, (std::vector<std::string>{"inject_rsm", "-", "32"}));
    EXPECT_EQ(variants[0].setup.graph.text(), "[{pass: voxelize, resolution: 32}, {pass: inject_rsm, id: inject}]");
    EXPECT_EQ(variants[4].setup.graph.items[1].text(), "{pass: place_surfels, count: 20}");

    // A pass that no variant has is a mistake
    EXPECT_CONTAINS(sweepError("  inject: [inject_rsm, [place_surfels, inject_voxel_rays]]\n"
                               "  place_surfel.count: [10]\n"),
                    "demo.yaml:8: 'place_surfel'");
}

TEST(Sweep, LabelsTellWhatDiffers) {
    const auto labels = [](const std::string& list) {
        std::vector<std::string> texts;
        for (const SweepPoint& variant : expand("  inject: " + list + "\n")) texts.push_back(variant.values[0]);
        return texts;
    };
    using Texts = std::vector<std::string>;
    EXPECT_EQ(labels("[{pass: a, n: 1, m: 2}, {pass: a, n: 3, m: 2}, {pass: b, n: 1}]"),
              (Texts{"a, n 1", "a, n 3", "b"}));
    EXPECT_EQ(labels("[a, {pass: a, n: 1}]"), (Texts{"a", "a, n 1"}));
    EXPECT_EQ(labels("[{pass: a, inputs: {noise: x}}, {pass: a, inputs: {noise: y}}]"),
              (Texts{"a, noise x", "a, noise y"}));

    // A chain is named by its last pass, or by the one that a filter follows
    EXPECT_EQ(labels("[[{pass: a, n: 1}, b], [{pass: a, n: 2}, b], [b, {pass: a}]]"), (Texts{"b, n 1", "b, n 2", "a"}));
    EXPECT_EQ(labels("[[a, b], [a, c, b], [a, c, d]]"), (Texts{"b", "b, c", "d"}));
    EXPECT_EQ(labels("[gather_cones, {pass: path_trace, spp: 1}, {pass: path_trace, spp: 4}, "
                     "[{pass: path_trace, spp: 4}, filter_irradiance], "
                     "[{pass: path_trace, spp: 4}, accumulate, filter_irradiance]]"),
              (Texts{"gather_cones", "path_trace, spp 1", "path_trace, spp 4", "path_trace, spp 4, filtered",
                     "path_trace, spp 4, accumulated, filtered"}));
    EXPECT_EQ(labels("[[{pass: rays, n: 1, m: 8}, gather, filter_irradiance], "
                     "[{pass: rays, n: 2, m: 8}, gather, filter_irradiance], "
                     "[{pass: rays, n: 2, m: 4}, gather, filter_irradiance]]"),
              (Texts{"gather, n 1, filtered", "gather, n 2, m 8, filtered", "gather, n 2, m 4, filtered"}));

    // A parameter that two of the chains' passes have is told with its pass
    EXPECT_EQ(labels("[[{pass: a, n: 1}, {pass: b, n: 3}], [{pass: a, n: 2}, {pass: b, n: 3}], "
                     "[{pass: a, n: 2}, {pass: b, n: 4}]]"),
              (Texts{"b, b.n 3, a.n 1", "b, b.n 3, a.n 2", "b, b.n 4"}));

    // What is said of others does not change if one is added
    EXPECT_EQ(labels("[{pass: a, n: 1}, {pass: a, n: 3}, {pass: b, n: 1}, [{pass: c, n: 5}, d], d]"),
              (Texts{"a, n 1", "a, n 3", "b", "d, c", "d"}));

    // Not enough: the whole text
    EXPECT_EQ(labels("[[{pass: a}, b], [{pass: a, id: x}, b], c]"),
              (Texts{"[{pass: a}, b]", "[{pass: a, id: x}, b]", "c"}));
}

TEST(Sweep, AMapNamesItsValues) {
    const auto variants = expand(
        "  inject:\n"
        "    from lights: inject_light_rays\n"
        "    from the camera: [place_surfels, {pass: inject_camera_rays, bounces: 2}]\n"
        "  voxelize.resolution: {coarse: 32, fine: 64}\n");
    ASSERT_EQ(variants.size(), 4u);
    EXPECT_EQ(variants[0].name, "from lights, coarse");
    EXPECT_EQ(variants[3].values, (std::vector<std::string>{"from the camera", "fine"}));
    EXPECT_EQ(variants[3].setup.graph.text(),
              "[{pass: voxelize, resolution: 64}, {pass: place_surfels}, {pass: inject_camera_rays, bounces: 2, id: "
              "inject}]");

    EXPECT_CONTAINS(sweepError("  inject: {}\n"), "demo.yaml:7: sweep.inject: ");
    EXPECT_CONTAINS(sweepError("  inject: {pass: inject_rsm}\n"), "as in [{pass: inject_rsm}]");
}

TEST(Sweep, ConfigAxes) {
    const auto variants = expand(
        "  image.width: [16, 32]\n  scene.lights: [point, spot]\n  seed: [1, 2]\n"
        "  tracer: [embree, ray_query]\n");
    ASSERT_EQ(variants.size(), 16u);
    EXPECT_EQ(variants[15].setup.image.width, 32u);
    EXPECT_EQ(variants[15].setup.scene.source.builtinParameters.find("lights")->scalar, "spot");
    EXPECT_EQ(variants[15].setup.general.seed, 2u);
    EXPECT_EQ(variants[15].setup.general.tracer, TracerKind::RayQuery);
}

TEST(Sweep, NamesWithDotsAreOneKey) {
    const auto variantsOf = [](const std::string& overrides, const std::string& axis) {
        return expandSweep(parseExperiment("name: demo\nscene: {builtin: cornell, override: {" + overrides +
                                               "}}\ngraph: [{pass: voxelize}]\nsweep: {" + axis + ": [0, 1]}\n",
                                           "demo.yaml"),
                           kFilters);
    };
    // In quotes anywhere; without them where the config has the name already, the longest of several
    for (const auto& [overrides, axis] : std::vector<std::pair<std::string, std::string>>{
             {"", "scene.override.\"Wood.001\".metallic"},
             {"Wood.001: {roughness: 0.5}", "scene.override.\"Wood.001\".metallic"},
             {"Wood: {roughness: 0.1}, Wood.001: {roughness: 0.5}", "scene.override.Wood.001.metallic"}}) {
        const auto variants = variantsOf(overrides, axis);
        ASSERT_EQ(variants.size(), 2u);
        EXPECT_EQ(variants[1].name, "metallic 1");
        const MaterialOverride& changed = variants[1].setup.scene.overrides.back();
        EXPECT_EQ(changed.material, "Wood.001");
        EXPECT_EQ(changed.change.settings.metallic, 1);
    }
    EXPECT_CONTAINS(errorOf<UsageError>([&] { variantsOf("", "scene.override.Wood.001.metallic"); }),
                    "scene.override.Wood: no setting of a material is called '001'; "
                    "in a path a name with dots stands in double quotes: scene.override.\"Wood.001\"");
}

TEST(Sweep, NamesAreSafeAndUnique) {
    const auto variants = expand(
        "  inject.write: ['a/b', 'a:b', '../x', \"\xc3\xa9\", '']\n"
        "  scene: [{builtin: cornell, lights: area}, {builtin: cornell, lights: spot}]\n");
    std::set<std::string> names, ids;
    for (const SweepPoint& v : variants) {
        EXPECT_TRUE(names.insert(v.name).second) << v.name;
        EXPECT_TRUE(ids.insert(v.id).second) << v.id;
        EXPECT_EQ(v.id.find_first_of("/:\\, "), std::string::npos) << v.id;
        EXPECT_LE(v.id.size(), 140u);
    }
    EXPECT_EQ(names.size(), 10u);

    // The config's keys are told as they are, numbers with the axis
    const auto named = expand("  inject: {\"rays: 1/pixel\": a, 4: a b}\n  seed: {7: 7, on: 8}\n");
    EXPECT_EQ(named[0].name, "rays: 1/pixel, seed 7");
    EXPECT_EQ(named[0].id, "rays-1-pixel-seed-7");
    EXPECT_EQ(named[3].name, "inject 4, on");

    // Names that differ in signs which no id has
    const auto alike = expand("  inject: {a b: a, a-b: b}\n");
    EXPECT_EQ(alike[1].id, "a-b-2");

    // Ids are folders next to those of references
    const auto folders = expand("  inject: {reference: a, reference.2: b, α: c, -x: d, .tmp: e, e: f}\n");
    const std::vector<std::string> expected{
        "variant-reference", "variant-reference.2", "variant", "x", "variant-.tmp", "e"};
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(folders.at(i).id, expected[i]);
}

TEST(Sweep, Errors) {
    EXPECT_CONTAINS(sweepError("  inject: {\"-\": a, b: b}\n"), "'-'");
    EXPECT_CONTAINS(sweepError("  reference.spp: [1, 2]\n"), "demo.yaml:7: sweep: ");
    EXPECT_CONTAINS(sweepError("  voxelise.resolution: [1]\n"), "'voxelize'");
    EXPECT_CONTAINS(sweepError("  image.widht: [1]\n"), "demo.yaml:7: image: ");
    EXPECT_CONTAINS(sweepError("  voxelize.resolution: [64, 64]\n"), "appears twice");
    std::string many = "[0";
    for (int i = 1; i < 200; ++i) many += ", " + std::to_string(i);
    many += "]\n";
    EXPECT_CONTAINS(sweepError("  inject.a: " + many + "  inject.b: " + many), "more than 10000");
}

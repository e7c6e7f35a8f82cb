// Counterparts of stages: every pass is in the table, the graphs that it makes are whole, what it lacks is
// refused.
#include "experiment/counterparts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "config/yaml.h"
#include "passes/common/families.h"
#include "tests/support/errors.h"
#include "tests/support/places.h"

using namespace voxray;

namespace {

Registry allPasses() {
    Registry registry;
    registerPasses(registry);
    return registry;
}

Value table() {
    return readYaml(test::sourceRoot() / "passes" / "counterparts.yaml");
}

constexpr const char* kReference = "reference: {pass: path_trace, spp: 64, bounces: 8}\n";

/// A config of one variant: a g-buffer and `passes`, direct light and the sum of both.
std::string configOf(const std::string& passes, const std::string& rest = kReference) {
    return "name: x\nscene: {builtin: cornell}\ngraph: [{pass: gbuffer, samples_per_pixel_edge: 2}, " +
           passes + ", {pass: direct_shadow_rays}, {pass: composite}]\n" + rest;
}

SwapPlan planOf(const std::string& config) {
    const Registry registry = allPasses();
    const Study wired = wireExperiment(parseExperiment(config, "x.yaml"), registry);
    SwapPlan plan = planSwaps(table(), wired, wired.variants.front(), registry);
    EXPECT_EQ(wireExperiment(plan.experiment, registry).variants.size(), plan.swaps.size());
    return plan;
}

std::vector<std::string> stagesOf(const SwapPlan& plan) {
    std::vector<std::string> names;
    for (const SwappedStage& stage : plan.stages) names.push_back(stage.name);
    return names;
}

using Names = std::vector<std::string>;
constexpr const char* kLightRays =
    "{pass: voxelize, resolution: 64}, {pass: inject_light_rays, id: inject, rays_per_light: 65536, bounces: "
    "7}, ";
constexpr const char* kRays =
    "{pass: trace_gather_rays, rays_per_block: 16, block: 8}, {pass: gather_rays}, "
    "{pass: filter_irradiance}";

}  // namespace

TEST(Counterparts, TableKnowsEveryPassOnce) {
    std::vector<std::string> listed = passesInTable(table()), registered;
    const Registry registry = allPasses();
    for (const PassKind& kind : registry.kinds()) registered.push_back(kind.name);
    std::ranges::sort(listed);
    std::ranges::sort(registered);
    EXPECT_EQ(listed, registered) << "a new pass belongs into passes/counterparts.yaml";
}

TEST(Families, HoldEveryPass) {
    Registry linked;
    EXPECT_EQ(addRegistered(linked, "passes/"), allPasses().kinds().size())
        << "a new pass belongs into the folder of a family (passes/common/families.h)";
}

TEST(Families, SummariesFitALine) {
    const Registry registry = allPasses();
    for (const PassKind& kind : registry.kinds()) {
        const std::string summary = kind.help.substr(0, kind.help.find(". "));
        EXPECT_LE(summary.size(), 90u) << kind.name << ": " << summary;
    }
}

TEST(Counterparts, GatherRays) {
    const SwapPlan plan = planOf(configOf(std::string(kLightRays) + kRays));
    EXPECT_EQ(stagesOf(plan), (Names{"injection", "gather", "voxelization", "filter", "upsampling"}));
    EXPECT_EQ(plan.stages[0].changes, (Names{"inject.rays_per_light 65536 → 1048576"}));
    EXPECT_EQ(plan.stages[1].changes,
              (Names{"trace_gather_rays.rays_per_block 16 → 1024", "trace_gather_rays.block 8 → 1"}));
    EXPECT_EQ(plan.stages[2].changes,
              (Names{"voxelize.resolution 64 → 256", "inject.rays_per_light 1048576 → 4194304"}));
    EXPECT_EQ(plan.stages[2].needs, (Names{"injection", "gather"}));
    EXPECT_EQ(plan.stages[3].changes, (Names{"without filter_irradiance"}));
    // Without injection or gather; the filter with gather; voxels, filter and texels with both
    EXPECT_EQ(plan.swaps.size(), 2u + 2u + 8u);
    EXPECT_EQ(plan.swaps.front(), Names{});
}

TEST(Counterparts, OtherMethods) {
    const auto stages = [](const std::string& passes) { return stagesOf(planOf(configOf(passes))); };
    const std::string voxels = kLightRays, trace = "{pass: trace_gather_rays, rays_per_block: 16}, ";
    EXPECT_EQ(stages(voxels + "{pass: filter_voxels, layout: clipmap, clipmap_resolution: 32}, "
                              "{pass: gather_cones, cones: 6, stride: 4, specular: 0}"),
              (Names{"injection", "gather", "voxelization", "visibility", "upsampling"}));
    EXPECT_EQ(stages(voxels + "{pass: gather_irradiance}"),
              (Names{"injection", "voxelization", "upsampling"}));
    EXPECT_EQ(stages("{pass: path_trace, spp: 1, light: indirect}, {pass: filter_irradiance}"),
              (Names{"gather", "filter", "upsampling"}));
    EXPECT_EQ(stages("{pass: update_radiance_cache, rays_per_image: 65536}, " + trace +
                     "{pass: gather_cached_rays}"),
              (Names{"injection", "gather", "voxelization", "upsampling"}));
    EXPECT_EQ(stages(voxels + "{pass: merge_voxels}, " + trace + "{pass: gather_merged_rays}"),
              (Names{"injection", "gather", "voxelization", "upsampling"}));
    EXPECT_EQ(
        stages("{pass: sample_vpls, vpls_per_bounce: 64}, {pass: gather_vpls, visibility: exact, bound: 0}"),
        (Names{"injection", "gather", "upsampling"}));
    for (const char* inject :
         {"inject_rsm", "inject_shadow_map", "inject_voxel_rays", "inject_camera_rays"}) {
        const SwapPlan plan =
            planOf(configOf("{pass: voxelize}, {pass: place_surfels}, {pass: " + std::string(inject) +
                            ", bounces: 5}, {pass: gather_irradiance}"));
        EXPECT_EQ(plan.stages[0].changes, (Names{"inject_light_rays in place of " + std::string(inject)}));
        EXPECT_NE(plan.experiment.sweep.text().find("rays_per_light: 16777216, bounces: 5"),
                  std::string::npos);
    }
}

TEST(Counterparts, RaysThroughHybridLeavesGiveWayToTheRayTracer) {
    const std::string passes = std::string(kLightRays) + "{pass: filter_voxels}, {pass: gather_irradiance}, ";
    const SwapPlan plan = planOf(configOf(passes + "{pass: build_hybrid_leaves}, {pass: gather_mirror, walk: "
                                                   "hierarchical, wide_rays: cones}"));
    EXPECT_EQ(stagesOf(plan), (Names{"injection", "gather", "voxelization", "visibility", "upsampling"}));
    EXPECT_EQ(plan.stages[1].changes,
              (Names{"gather_mirror.rays 1 → 64", "gather_mirror.light_samples 1 → 16"}));
    EXPECT_EQ(plan.stages[3].needs, Names{"gather"});
    const Names& changes = plan.stages[3].changes;
    EXPECT_EQ(std::ranges::count(changes, "without build_hybrid_leaves"), 1);
    EXPECT_EQ(std::ranges::count(changes, "gather_mirror.walk hierarchical → exact"), 1);
}

TEST(Counterparts, WhatIsAsFineAlreadyIsNoStage) {
    EXPECT_EQ(stagesOf(planOf(
                  configOf("{pass: voxelize, resolution: 512}, {pass: inject_light_rays, rays_per_light: "
                           "33554432}, {pass: gather_irradiance}"))),
              (Names{"upsampling"}));
    // A number beyond the most that a counterpart takes stays
    EXPECT_EQ(planOf(configOf(std::string(
                         "{pass: voxelize, resolution: 300}, {pass: inject_light_rays, rays_per_light: "
                         "4194304}, {pass: gather_irradiance}")))
                  .stages[1]
                  .changes,
              (Names{"voxelize.resolution 300 → 512"}));
}

TEST(Counterparts, WhatCannotBeExplainedIsRefused) {
    const auto message = [](const std::string& config) {
        return errorOf<UsageError>([&] { planOf(config); });
    };
    const std::string voxels = kLightRays;
    EXPECT_CONTAINS(message(configOf(voxels + kRays + ", {pass: accumulate}")),
                    "x.yaml:3: 'accumulate' has no exact counterpart");
    EXPECT_CONTAINS(message(configOf(voxels + "{pass: gather_irradiance}", "")), "there is no 'reference'");
    EXPECT_CONTAINS(message("name: x\nscene: {builtin: cornell}\ngraph: [{pass: path_trace, spp: 5000}]\n" +
                            std::string(kReference)),
                    "nothing to explain");
}

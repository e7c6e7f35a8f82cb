// What compare_voxels counts, against bits counted here.
#include <gtest/gtest.h>

#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::map<std::string, double> reported(const Chain& chain) {
    std::map<std::string, double> values;
    for (const PassContext::Value& v : chain.buildSamples.back().reported) values[v.name] = v.value;
    return values;
}

TEST(CompareVoxels, CountsWhatIsMissedAndAdded) {
    // A sphere: three_axis misses voxels that it cuts near a corner, dominant_axis adds some. Swapped, what
    // was missed is added.
    const auto graph = [](const std::string& truth, const std::string& voxels) {
        return graphYaml({"voxelize, id: a, visibility_rays: 0, method: exact",
                          "voxelize, id: b, visibility_rays: 0, method: three_axis, samples_per_voxel_edge: 1",
                          "compare_voxels, inputs: {truth: " + truth + ".voxels, voxels: " + voxels + ".voxels}"});
    };
    Chain chain("furnace", "{}", graph("a", "b"));
    std::map<std::string, double> counted = reported(chain);
    Chain exact("furnace", "{}", graphYaml({"voxelize, visibility_rays: 0, method: exact"}));
    Chain other("furnace", "{}",
                graphYaml({"voxelize, visibility_rays: 0, method: three_axis, samples_per_voxel_edge: 1"}));
    const Voxels truth(exact), found(other);
    int missed = 0, added = 0;
    truth.forEach([&](glm::ivec3 v) {
        missed += truth.occupied(v) && !found.occupied(v);
        added += !truth.occupied(v) && found.occupied(v);
    });
    EXPECT_GT(missed, 100);
    EXPECT_EQ(counted["missed"], missed);
    EXPECT_EQ(counted["added"], added);
    EXPECT_EQ(counted["voxels"], truth.count);
    EXPECT_NEAR(counted["area ratio"], found.area() / truth.area(), 1e-6);

    std::map<std::string, double> swapped = reported(Chain("furnace", "{}", graph("b", "a")));
    EXPECT_EQ(swapped["missed"], added);
    EXPECT_EQ(swapped["added"], missed);
    EXPECT_NEAR(swapped["area ratio"] * counted["area ratio"], 1.0, 1e-6);
}

TEST(CompareVoxels, RefusesDifferentGrids) {
    EXPECT_ERROR("'resolution'", Chain("cornell", "{}",
                                       graphYaml({"voxelize, id: a, resolution: 8", "voxelize, id: b, resolution: 9",
                                                  "compare_voxels, inputs: {truth: a.voxels}"})));
}

}  // namespace
}  // namespace voxray::test

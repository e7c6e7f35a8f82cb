// What compare_voxels counts, against bits counted here.
#include <gtest/gtest.h>

#include "tests/physics/voxels_read.h"

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
    const std::string graph =
        "[{pass: voxelize, id: a, resolution: 32, visibility_rays: 0, method: exact},"
        " {pass: voxelize, id: b, resolution: 32, visibility_rays: 0, method: three_axis, samples: 1},"
        " {pass: compare_voxels, inputs: {truth: ";
    Chain chain("furnace", "{}", graph + "a.voxels, voxels: b.voxels}}]");
    std::map<std::string, double> counted = reported(chain);
    Chain exact("furnace", "{}", "[{pass: voxelize, resolution: 32, visibility_rays: 0, method: exact}]");
    Chain other("furnace", "{}",
                "[{pass: voxelize, resolution: 32, visibility_rays: 0, method: three_axis, samples: 1}]");
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

    std::map<std::string, double> swapped =
        reported(Chain("furnace", "{}", graph + "b.voxels, voxels: a.voxels}}]"));
    EXPECT_EQ(swapped["missed"], added);
    EXPECT_EQ(swapped["added"], missed);
    EXPECT_NEAR(swapped["area ratio"] * counted["area ratio"], 1.0, 1e-6);
}

TEST(CompareVoxels, RefusesDifferentGrids) {
    try {
        Chain("cornell", "{}",
              "[{pass: voxelize, id: a, resolution: 8}, {pass: voxelize, id: b, resolution: 9},"
              " {pass: compare_voxels, inputs: {truth: a.voxels}}]");
        ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'resolution'"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace voxray::test

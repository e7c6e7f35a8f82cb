// Families of passes: they hold every pass, and lists of passes have room for each.
#include <gtest/gtest.h>

#include "passes/common/families.h"
#include "tests/support/all_passes.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {}  // namespace

TEST(Families, HoldEveryPass) {
    Registry linked;
    EXPECT_EQ(addRegistered(linked, "passes/"), test::allPasses().kinds().size())
        << "a new pass belongs into the folder of a family (passes/common/families.h)";
}

TEST(Families, SummariesFitALine) {
    const Registry registry = test::allPasses();
    for (const PassKind& kind : registry.kinds()) {
        const std::string summary = kind.help.substr(0, kind.help.find(". "));
        EXPECT_LE(summary.size(), 90u) << kind.name << ": " << summary;
    }
}

TEST(Families, NamesOfBeforeTellWhatToWrite) {
    const Registry registry = test::allPasses();
    const auto message = [&](const std::string& name) {
        return errorOf<UsageError>([&] { registry.require(name, {"x.yaml", 4}); });
    };
    EXPECT_EQ(message("inject_gather_hits"),
              "x.yaml:4: 'inject_gather_hits' is now inject_voxel_rays with 'points: gather_hits'");
    EXPECT_EQ(message("direct_voxels"), "x.yaml:4: 'direct_voxels' is now gather_irradiance with 'light: direct'");
}

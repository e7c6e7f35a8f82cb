// Families of passes: they hold every pass, and lists of passes have room for each.
#include <gtest/gtest.h>

#include "passes/common/families.h"

using namespace voxray;

namespace {

Registry allPasses() {
    Registry registry;
    registerPasses(registry);
    return registry;
}

}  // namespace

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

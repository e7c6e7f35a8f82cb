#include <gtest/gtest.h>

#include <filesystem>

#include "experiment/scene_setup.h"
#include "experiment/validate.h"
#include "passes/register_passes.h"

using namespace voxray;
namespace fs = std::filesystem;

/// Every config that is shipped, with each of its profiles.
TEST(ShippedConfigs, ReadAndValidate) {
    Registry registry;
    registerPasses(registry);
    int configs = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(VOXRAY_SOURCE_DIR) / "configs")) {
        if (entry.path().extension() != ".yaml") continue;
        ++configs;
        std::vector<std::string> profiles = profileNames(entry.path());
        profiles.insert(profiles.begin(), "");
        for (const std::string& profile : profiles) {
            SCOPED_TRACE(entry.path().string() + " " + profile);
            try {
                const WiredExperiment wired =
                    wireExperiment(loadExperiment(entry.path(), {profile, {}}), registry);
                SceneLoader loader({});
                for (const WiredVariant& variant : wired.variants)
                    if (!variant.setup.scene.source.builtin.empty()) loader.prepare(variant.setup.scene);
            } catch (const Error& error) {
                ADD_FAILURE() << error.what();
            }
        }
    }
    EXPECT_GT(configs, 0);
}

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "experiment/scene_setup.h"
#include "experiment/study.h"
#include "tests/support/all_passes.h"
#include "tests/support/places.h"

using namespace voxray;
namespace fs = std::filesystem;

/// Scene files are not part of the repository.
bool needsFiles(const SceneSettings& scene) {
    return !scene.source.file.empty() ||
           std::ranges::any_of(scene.additions, [](const SceneAddition& added) { return !added.source.file.empty(); });
}

/// Every config that is shipped, with each of its profiles.
TEST(ShippedConfigs, ReadAndValidate) {
    const Registry registry = test::allPasses();
    int configs = 0;
    for (const auto& entry : fs::recursive_directory_iterator(test::sourceRoot() / "configs")) {
        if (entry.path().extension() != ".yaml") continue;
        ++configs;
        std::vector<std::string> profiles = profileNames(entry.path());
        profiles.insert(profiles.begin(), "");
        for (const std::string& profile : profiles) {
            SCOPED_TRACE(entry.path().string() + " " + profile);
            try {
                const Study wired = makeStudy(loadExperiment(entry.path(), {profile, {}}), registry);
                SceneLoader loader({entry.path().parent_path()});
                for (const Variant& variant : wired.variants)
                    if (!needsFiles(variant.setup.scene)) loader.prepare(variant.setup.scene);
            } catch (const Error& error) {
                ADD_FAILURE() << error.what();
            }
        }
    }
    EXPECT_GT(configs, 0);
}

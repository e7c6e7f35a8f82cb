#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/value.h"
#include "config/settings.h"

namespace voxray {

/// The settings of one variant.
struct Setup {
    GeneralSettings general;
    SceneSettings scene;
    ImageSettings image;
    Value graph;  ///< The list of passes, which class Graph checks.
};

/// A config with profile and assignments applied, before its sweep is expanded.
struct Experiment {
    std::filesystem::path file;  ///< Empty for a config from text.
    Value config;                ///< Without `profiles`.
    Setup setup;
    MeasureSettings measure;
    Value reference;                    ///< One entry of a graph, or null: no reference, no metrics.
    Value sweep = Value::map();         ///< Axes: paths with non-empty lists of values, in the file's order.
    std::vector<std::string> warnings;  ///< With file and line.
};

struct ConfigOptions {
    std::string profile;                   ///< Empty: none.
    std::vector<std::string> assignments;  ///< "path=value" of --set, applied in order after the profile.
};

/// Reads and checks a config including all its profiles, except the graph's passes and the contents of scene
/// files.
/// @throws UsageError with file, line and the nearest valid word.
Experiment loadExperiment(const std::filesystem::path& path, const ConfigOptions& options = {});
/// Reads a config from text; `fileName` is for messages.
Experiment parseExperiment(const std::string& yaml, const std::string& fileName, const ConfigOptions& options = {});
/// The same of a config that was parsed.
Experiment readExperiment(const Value& root, const ConfigOptions& options);
/// Reads a config with all overrides applied.
Experiment readExperiment(Value config);

/// The experiment with other contents of its config: after selectSweepValues().
Experiment withConfig(const Experiment& experiment, Value config);

/// Names of a config's profiles, in the file's order.
std::vector<std::string> profileNames(const std::filesystem::path& path);

/// Reads a variant's setup from a config with its values applied.
Setup readSetup(const Value& config);

}  // namespace voxray

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/value.h"
#include "config/settings.h"

namespace voxray {

/// What one variant renders.
struct Setup {
    GeneralSettings general;
    SceneSettings scene;
    ImageSettings image;
    Value graph;  ///< The list of passes, unchecked: class Graph checks it.
};

/// A config, read: profile and assignments applied, the sweep not yet.
struct Experiment {
    std::filesystem::path file;  ///< Empty for a config from text.
    Value config;                ///< The whole config, without `profiles`.
    Setup setup;
    MeasureSettings measure;
    Value reference;                    ///< One entry of a graph, or null: no reference, no metrics.
    Value sweep = Value::map();         ///< Path -> non-empty list, in the file's order.
    std::vector<std::string> warnings;  ///< What may not be meant, with file and line.
};

struct ConfigOptions {
    std::string profile;                   ///< Empty: none.
    std::vector<std::string> assignments;  ///< "path=value" of --set, applied in order after the profile.
    std::vector<std::string> only = {};    ///< "axis=value" of --only: values of the sweep that stay.
};

/// Reads a config. Everything but the graph's passes and the contents of scene files is checked, all its
/// profiles too.
/// @throws UsageError with file, line and the nearest valid word.
Experiment loadExperiment(const std::filesystem::path& path, const ConfigOptions& options = {});
/// The same from text; `fileName` is for messages.
Experiment parseExperiment(const std::string& yaml, const std::string& fileName,
                           const ConfigOptions& options = {});
/// The same from a whole config with all overrides in place.
Experiment readExperiment(Value config);

/// Names of a config's profiles, in the file's order.
std::vector<std::string> profileNames(const std::filesystem::path& path);

/// Reads what one variant renders from a config with a variant's values in place.
Setup readSetup(const Value& config);

}  // namespace voxray

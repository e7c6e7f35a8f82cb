#pragma once

#include <string>
#include <vector>

#include "base/value.h"

/// Changes to a config before it is read, by profiles, `--set` and sweeps. Values have dotted paths:
///   image.width            a key of the config
///   voxelize.resolution    a parameter of the pass with that id
///   inject                 a pass: its name, a map with `pass`, or a list of these (a chain), whose last
///                          pass gets the id and may have no other
///   sweep.inject           an axis of the sweep (followed by the axis' path); a map in which a name has null
///                          changes its named values, others take its place
///   sweep.inject.rays      the value of that name of an axis; null takes it out
///   scene.override."Wood.001".metallic    a name with dots, in quotes unless it exists already
namespace voxray {

/// Top-level keys of a config.
const std::vector<std::string>& configKeys();

/// The id of an entry of `graph`: its `id`, else its `pass`; "" if it has neither.
std::string passId(const Value& entry);

/// The command-line option for a setting that is a config key in other tools; "" if there is none.
std::string optionFor(const std::string& key);

/// Whether the first component of `path` exists: a key of the config, or a pass of its graph.
bool hasTarget(const Value& config, const std::string& path);

/// The value at `path`: a key, a pass of the graph, or a parameter of one; nullptr if missing.
const Value* valueAt(const Value& config, const std::string& path);

enum class Merge {
    Maps,    ///< Merges maps key by key (profiles, --set).
    Replace  ///< Replaces the value (sweeps).
};

/// Location of the value at `path`, else of the innermost existing map.
TextLocation locationOf(const Value& config, const std::string& path);

/// The last key of a path.
std::string lastKey(const Value& config, const std::string& path);

/// Sets the value at `path`; null removes it. Errors are located at `value.where`.
/// @throws UsageError for an invalid path, with the nearest valid one.
void applyOverride(Value& config, const std::string& path, const Value& value, Merge merge = Merge::Maps);

/// Applies the named block of `profiles`. @throws UsageError for an unknown profile.
void applyProfile(Value& config, const std::string& name);

/// Applies "path=value" with a YAML value. @throws UsageError without '=' or for invalid YAML.
void applyAssignment(Value& config, const std::string& assignment);

}  // namespace voxray

#pragma once

#include <string>
#include <vector>

#include "base/value.h"

/// Changes to a config before it is read: profiles, `--set`, sweeps. All name a place by a dotted path:
///   image.width            a key of the config
///   voxelize.resolution    a parameter of the pass with that id
///   inject                 a whole pass: a name, a map with `pass`, or a list of these, a chain; the id
///                          stays, with the chain's last pass
///   sweep.inject           an axis of the sweep (the rest of the path is the axis' own path)
///   scene.override."Wood.001".metallic    a name with dots, in quotes where it does not stand there already
namespace voxray {

/// Keys of a config's top level.
const std::vector<std::string>& configKeys();

/// The id of an entry of `graph`: its `id`, else its `pass`; "" where it has neither.
std::string passId(const Value& entry);

/// The option of the command line that says what configs of other tools say with that key; "" for other
/// words.
std::string optionFor(const std::string& key);

/// Whether what `path` begins with is there: a key of the config, or a pass of its graph.
bool hasTarget(const Value& config, const std::string& path);

/// What `path` names: a key, a pass of the graph, or a parameter of one; nullptr where nothing is written.
const Value* valueAt(const Value& config, const std::string& path);

enum class Merge {
    Maps,    ///< A map is merged into the map that is there, key by key (profiles, --set).
    Replace  ///< The new value stands alone (sweeps).
};

/// Where the value that `path` names stands, or else the nearest map round it.
TextLocation placeOf(const Value& config, const std::string& path);

/// The key that a path ends with.
std::string lastKey(const Value& config, const std::string& path);

/// Sets what `path` names to `value`; null takes it out. Errors are located at `value.where`.
/// @throws UsageError for a path that leads nowhere, with the nearest valid one.
void applyOverride(Value& config, const std::string& path, const Value& value, Merge merge = Merge::Maps);

/// Applies the named block of `profiles`. @throws UsageError for an unknown profile.
void applyProfile(Value& config, const std::string& name);

/// Applies "path=value", the value being YAML. @throws UsageError where there is no '=' or the YAML is bad.
void applyAssignment(Value& config, const std::string& assignment);

}  // namespace voxray

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/value.h"
#include "graph/pass.h"
#include "graph/pass_memory_tracker.h"
#include "graph/registry.h"

namespace voxray {

/// Time and cost of one pass in one run of its phase.
struct PassSample {
    double milliseconds = 0;
    uint64_t rays = 0;
    uint64_t voxelSteps = 0;  ///< Steps of voxel marches, counted on the device.
    StreamCounts work = {};   ///< Recorded by the pass, without those of the measurement.
    std::string clock{};      ///< PassContext::ToldTime; empty: the device's time stamps.
    std::vector<PassContext::Value> reported;
};

/// One pass of a graph with what its ports are bound to.
struct GraphNode {
    std::string id;
    std::string kind;  ///< Name in the registry.
    std::unique_ptr<Pass> pass;
    Phase phase = Phase::Build;  ///< The pass's, or Frame if it reads what is written in each frame.
    std::vector<PortInfo> ports;
    std::vector<Resource*> resources;  ///< One per port; null for an optional input that nothing writes.
    std::optional<std::vector<uint64_t>> seenVersions;  ///< Resources' versions at its last run.
    std::vector<std::unique_ptr<Resource>> outputs;     ///< Owned by this pass.
    Value resolved;                                     ///< The config's entry with defaults filled in.
    std::vector<std::string> sizeParameters;            ///< Integer parameters above their minimum.
    std::vector<std::string> noiseParameters;           ///< Parameters whose larger values lower its noise.
    std::vector<UnusedSetting> unused;                  ///< Parameters of its entry that have no effect.
    TextLocation where;
    uint64_t lightRays = 0;  ///< As planned.
    PassMemoryTracker memory;
    PassSample lastSample;   ///< Of its last run.
    bool isReused = false;   ///< Taken from another graph with its outputs (Graph::reuse()).
    bool isSkipped = false;  ///< Does not run (Graph::runOnlyFor()).
};

/// Index of a node's port of that name.
std::optional<size_t> inputNamed(const GraphNode& node, const std::string& name);
std::optional<size_t> outputNamed(const GraphNode& node, const std::string& name);

/// Checks an entry of a pass list by itself: its pass, its parameters and which inputs it names.
/// @throws UsageError with file and line.
void checkEntry(const Registry& registry, const Value& entry);

/// Reads a config's pass list, binds every port and sorts passes so that writers come before readers.
/// Passes that don't depend on each other keep the list's order.
/// @throws UsageError with file and line.
std::vector<GraphNode> wireGraph(const Registry& registry, const Value& passList);

/// Reads one more pass, and binds its inputs to outputs of a wired graph. It runs in each frame.
/// @throws UsageError with file and line, also for an input that its writer leaves empty because no other pass reads
/// it.
GraphNode wireLast(const Registry& registry, const std::vector<GraphNode>& nodes, const Value& entry);

}  // namespace voxray

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/value.h"
#include "graph/pass.h"
#include "graph/registry.h"

namespace voxray {

/// Time and cost of one pass in one run of its phase.
struct PassSample {
    double milliseconds = 0;
    uint64_t rays = 0;
    uint64_t voxelSteps = 0;  ///< Of rays that walk through voxels, counted on the device.
    StreamCounts work = {};   ///< Recorded by the pass; waits and copies of the measurement itself apart.
    std::vector<PassContext::Value> reported;
};

/// The most that passes hold at once: all that they keep, and the scratch of the one that takes most, for
/// they run one after another. Exact where all passes run again with the outputs of the last run still there,
/// as repeated builds, moving scenes and frames do. Of a plan: what is known, without estimates.
uint64_t peakBytes(const std::vector<PassMemory>& passes);
/// What a plan estimates besides.
uint64_t estimatedBytes(const std::vector<PassMemory>& passes);

/// A checked chain of passes. Each entry of a config's `graph` list is a map with `pass`, optionally `id`
/// (default: the pass's name) and `inputs` (port: "id.port" or "id"), and the pass's own parameters.
/// An input without an entry in `inputs` takes the nearest earlier pass that writes a port of its name.
class Graph {
 public:
    /// Keys of a graph entry that are not parameters of the pass.
    static const std::vector<std::string>& reservedKeys();

    /// Reads, wires and sorts the graph; touches no device.
    /// @throws UsageError with file and line: unknown pass or parameter, value out of range, duplicate id,
    /// missing or mistyped port, cycle.
    Graph(const Registry& registry, const Value& passList);
    ~Graph();
    Graph(Graph&&) noexcept;
    Graph& operator=(Graph&&) noexcept;

    struct PassInfo {
        std::string id;
        std::string kind;
        Phase phase;
        uint32_t framesBefore;  ///< Pass::framesBefore()
        TextLocation where;
        uint64_t lightRays;  ///< PassPlan's; 0 before it was planned.
    };
    /// In execution order.
    std::vector<PassInfo> passes() const;
    /// The config's list with every default filled in, in execution order.
    Value resolved() const;

    /// The parameters that the config's list names although others leave them without effect:
    /// "<id>.<parameter>".
    std::vector<UnusedSetting> unused() const;

    /// Drops every pass that none of the last writers of `portNames` depends on: it would take time and
    /// memory for nothing. A pass that writes nothing is there for what it reports, and stays. @return the
    /// dropped passes' ids.
    std::vector<std::string> keepOnly(const std::vector<std::string>& portNames);

    /// The parameters whose larger values lower the noise of what is written last under a name,
    /// "<id>.<parameter>", in execution order; without those that other parameters leave no effect. Empty: it
    /// has no such noise.
    std::vector<std::string> noiseParameters(const std::string& portName) const;

    /// Checks that what is written last under the name `part` is what the last writer of `whole` reads under
    /// it, unless that one's `inputs` choose another. @throws UsageError with file and line: a pass changes
    /// the part too late.
    void checkIsMadeOf(const std::string& whole, const std::string& part) const;

    /// An input of a pass, by the pass and the port.
    struct Input {
        std::string id;
        std::string port;
        TextLocation where;
    };
    /// Optional inputs of the last writer of a port that are bound to nothing.
    std::vector<Input> emptyInputs(const std::string& portName) const;

    /// That a pass is never run, why, and what to do about it, with its place: of one that no image that is
    /// compared depends on. Before keepOnly().
    std::string whyLeftOut(const std::string& id) const;

    /// A resource that will be read from outside, by port name: the last pass that writes it.
    bool writes(const std::string& portName) const;

    /// Checks parameters against the scene and the device and sums up the memory that is known, before any
    /// allocation. What passes count on the device is held to `memoryLimitBytes` when they take it.
    /// @return what each pass takes as far as it is known, in the order of passes().
    /// @throws Error where a pass can't do what is asked, or what is known is over `memoryLimitBytes` (names
    /// the largest part, and what to lower).
    std::vector<PassMemory> plan(const Frame& frame, const DeviceInfo& device, uint64_t memoryLimitBytes);

    /// Makes what passes described, compiles their programs, all at once, and lets them fill their tables.
    /// After plan(), with the same frame.
    /// @throws Error naming a pass that takes more memory than there is (with its place and what to lower).
    void prepare(const Frame& frame, Device& device, const ShaderCompiler& compiler, CommandStream& stream);

    /// Runs all passes of a phase once and checks their outputs for NaN and infinity where `checkFinite`
    /// (outside the measured time). @throws Error naming the pass, also where it takes more memory than there
    /// is.
    /// @return a sample for each pass of that phase, in the order of passes().
    std::vector<PassSample> run(Phase phase, const Frame& frame, Device& device, CommandStream& stream,
                                RayTracer& tracer, const GpuScene& scene, uint32_t frameIndex,
                                bool checkFinite);

    /// The AOVs of all resources that have some, with the id of the pass that wrote them.
    std::vector<std::pair<std::string, std::vector<Aov>>> aovs() const;

    /// What each pass has taken of the device's memory so far, in the order of passes().
    std::vector<PassMemory> memory() const;

    /// What the last pass with an output port of this name and type wrote, or nullptr.
    template <typename T>
    const T* resource(const std::string& portName) const {
        return static_cast<const T*>(find(portName, typeid(T)));
    }
    const Image* image(const std::string& portName) const {
        const FrameImage* frameImage = resource<FrameImage>(portName);
        return frameImage ? &frameImage->image : nullptr;
    }

 private:
    const Resource* find(const std::string& portName, std::type_index type) const;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace voxray

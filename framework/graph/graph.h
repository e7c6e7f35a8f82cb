#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/value.h"
#include "graph/finite_check.h"
#include "graph/wiring.h"

namespace voxray {

/// Peak memory: the persistent memory of all passes and the largest scratch, since they run one after
/// another. Exact where passes run again with the outputs of the last run still there, as in repeated builds,
/// moving scenes and frames. Of a plan: without estimates.
uint64_t peakBytes(const std::vector<PassMemory>& passes);
/// Estimates of a plan.
uint64_t estimatedBytes(const std::vector<PassMemory>& passes);

/// A checked chain of passes. Each entry of a config's `graph` list is a map with `pass`, optionally `id`
/// (default: the pass's name) and `inputs` (port: "id.port" or "id"), and the pass's own parameters.
/// An input without an entry in `inputs` takes the nearest earlier pass that writes a port of its name.
class Graph {
 public:
    /// Reads, wires and sorts the graph; touches no device.
    /// @throws UsageError with file and line: unknown pass or parameter, value out of range, duplicate id,
    /// missing or mistyped port, cycle.
    Graph(const Registry& registry, const Value& passList) : nodes_(wireGraph(registry, passList)) {}

    struct PassInfo {
        std::string id;
        std::string kind;
        Phase phase;
        uint32_t warmupFrames;  ///< Pass::warmupFrames()
        TextLocation where;
        uint64_t lightRays;      ///< PassPlan::lightRays; 0 before plan().
        bool isReused;           ///< Taken over by reuse().
        bool isSkipped = false;  ///< By runOnlyFor().
    };
    /// In execution order.
    std::vector<PassInfo> passes() const;
    /// The config's list with every default filled in, in execution order.
    Value resolved() const;

    /// Parameters in the config's list that have no effect because of others: "<id>.<parameter>".
    std::vector<UnusedSetting> unused() const;

    /// Culls passes that none of the last writers of `portNames` depends on. Passes without outputs, which
    /// report values, stay. @return the culled passes' ids.
    std::vector<std::string> cullUnused(const std::vector<std::string>& portNames);

    /// Parameters whose larger values lower the noise of the last output of a name: "<id>.<parameter>", in
    /// execution order, without those that have no effect.
    std::vector<std::string> noiseParameters(const std::string& portName) const;

    /// Checks that the last writer of `output` reads the last one written of `input`, unless its `inputs`
    /// choose another. @throws UsageError with file and line: a pass writes `input` too late.
    void checkReadsLatest(const std::string& output, const std::string& input) const;

    /// An input of a pass, by the pass and the port.
    struct Input {
        std::string id;
        std::string port;
        TextLocation where;
    };
    /// Unbound optional inputs of the last writer of a port.
    std::vector<Input> unboundInputs(const std::string& portName) const;

    /// Why a pass that no compared image depends on is never run, and a remedy, with file and line. Before
    /// cullUnused().
    std::string whyCulled(const std::string& id) const;

    /// Whether any pass has an output of this name.
    bool writes(const std::string& portName) const;

    /// Takes over the build passes of another graph, with their outputs, that have the same parameters and read the
    /// same outputs. They do not run again; run() returns the samples of their last run. Before plan(). Both graphs
    /// must have the same scene and seed, and the scene must not change in time. Afterwards `previous` can only be
    /// destroyed; programs of this graph that are equal to its programs are shared if it is destroyed after prepare().
    /// @param sameView whether camera and image size are the same, too.
    void reuse(Graph& previous, bool sameView);

    /// Adds a pass that runs last in each frame and reads what the others write. Before plan(), or, after keepAll(),
    /// before another plan(). @throws UsageError as the constructor, and for an input that is empty because no other
    /// pass reads it.
    void append(const Registry& registry, const Value& entry);
    /// Takes the appended pass away. The device must have run it.
    void dropLast() { nodes_.pop_back(); }
    /// Marks all passes as reused: plan(), prepare() and run() leave them and what they wrote as they are.
    void keepAll();
    /// Frame passes that a pass does not depend on, and that it isn't, are skipped by run(). Their samples are 0.
    void runOnlyFor(const std::string& id);

    /// What can be looked at of a pass in device memory: an image, of which an AOV is a part, or a buffer.
    struct View {
        std::string pass;
        std::string name;  ///< Of an AOV's layer, an image or a buffer; unlike all others of the pass.
        const Image* image = nullptr;
        std::vector<std::string> channels{};  ///< Names of the image's components; empty: unnamed.
        uint32_t firstChannel = 0;            ///< Of an AOV.
        bool isAov = false;
        Quantity quantity = Quantity::Other;
        Elements elements{nullptr};  ///< Has a buffer where `image` is null.
    };
    /// All that exists, by pass in execution order; of each, AOVs first, then output images of the frame, other images
    /// and buffers.
    std::vector<View> views(Device& device) const;

    /// Checks parameters against the scene and the device and sums up the known memory, before any
    /// allocation. Memory sized on the device is checked against `memoryLimitBytes` when it is allocated.
    /// @return known memory by pass, in the order of passes().
    /// @throws Error where a pass can't do what is asked, or the known memory exceeds `memoryLimitBytes`
    /// (names the largest allocation, and what to lower).
    std::vector<PassMemory> plan(const Frame& frame, const DeviceInfo& device, uint64_t memoryLimitBytes);

    /// Makes the described memory, compiles all programs in parallel, and prepares the passes. After plan(),
    /// with the same frame.
    /// @throws Error naming a pass that runs out of memory, with file and line and what to lower.
    void prepare(const Frame& frame, Device& device, const ShaderCompiler& compiler, CommandStream& stream);

    /// Runs all passes of a phase once; with `checkFinite` checks their outputs for NaN and infinity (outside
    /// the measured time). @throws Error naming the pass, also one that runs out of memory; Interrupted. None of the
    /// phase's passes is then reused.
    /// @return a sample by pass of that phase, in the order of passes().
    std::vector<PassSample> run(Phase phase, const Frame& frame, Device& device, CommandStream& stream,
                                RayTracer& tracer, const GpuScene& scene, uint32_t frameIndex, bool checkFinite);

    /// AOVs of all resources, by the id of the pass that wrote them.
    std::vector<std::pair<std::string, std::vector<Aov>>> aovs() const;

    /// Measured memory by pass so far, in the order of passes().
    std::vector<PassMemory> memory() const;
    /// Measured memory of the passes taken over by reuse().
    uint64_t reusedBytes() const;

    /// The last output of this name and type, or nullptr.
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
    /// Runs `work` of a pass. @throws Error with sizeAdvice() where a SizeError was thrown.
    void withSizeAdvice(const GraphNode& node, const std::function<void()>& work) const;
    void checkFiniteOutputs(const GraphNode& node, CommandStream& stream);

    std::vector<GraphNode> nodes_;  ///< In execution order.
    std::unique_ptr<FiniteCheck> finiteCheck_;
    uint64_t memoryLimitBytes_ = 0;
    Image black_;  ///< One texel, for inputs that nothing writes.
};

}  // namespace voxray

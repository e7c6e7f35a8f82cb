#include "graph/graph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/byte_units.h"
#include "graph/finite_check.h"
#include "graph/pass_culling.h"
#include "graph/pass_memory_tracker.h"
#include "graph/size_advice.h"
#include "graph/wiring.h"
#include "vulkan/size_error.h"

namespace voxray {

namespace {

/// Limits the device memory of a graph's passes while it lives. @param usedBytes by these passes already.
class MemoryLimit {
 public:
    MemoryLimit(Device& device, uint64_t bytes, uint64_t usedBytes)
        : device_(device), before_(device.memoryLimitBytes()) {
        const uint64_t others = device.memoryUsedBytes() - usedBytes;
        if (bytes < before_ - std::min(before_, others)) device.setMemoryLimitBytes(others + bytes);
    }
    ~MemoryLimit() { device_.setMemoryLimitBytes(before_); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
    Device& device_;
    const uint64_t before_;
};

/// Increments the versions of the outputs, and records which versions of all resources the pass has seen.
void updateVersions(GraphNode& node, bool outputsUnchanged) {
    if (!outputsUnchanged)
        for (const std::unique_ptr<Resource>& output : node.outputs) ++output->version;
    node.seenVersions.emplace();
    for (const Resource* resource : node.resources)
        node.seenVersions->push_back(resource ? resource->version : 0);
}

}  // namespace

struct Graph::Impl {
    std::vector<GraphNode> nodes;
    std::vector<PassMemoryTracker> memory;  ///< By node.
    std::optional<FiniteCheck> finiteCheck;
    uint64_t memoryLimitBytes = 0;
    Image black;  ///< One texel, for inputs that nothing writes.

    /// Runs `work` of a pass. @throws Error with sizeAdvice() where a SizeError was thrown.
    void withSizeAdvice(const GraphNode& node, const std::function<void()>& work) const;
    /// Persistent memory of all passes.
    uint64_t usedBytes() const;
    void checkOutputs(const GraphNode& node, CommandStream& stream);
};

uint64_t peakBytes(const std::vector<PassMemory>& passes) {
    uint64_t persistent = 0, scratch = 0;
    for (const PassMemory& pass : passes) {
        persistent += pass.bytes;
        scratch = std::max(scratch, pass.scratchBytes);
    }
    return persistent + scratch;
}

uint64_t estimatedBytes(const std::vector<PassMemory>& passes) {
    uint64_t bytes = 0;
    for (const PassMemory& pass : passes) bytes += pass.estimatedBytes;
    return bytes;
}

uint64_t Graph::Impl::usedBytes() const {
    uint64_t bytes = 0;
    for (const PassMemoryTracker& pass : memory) bytes += pass.used().bytes;
    return bytes;
}

const std::vector<std::string>& Graph::reservedKeys() {
    static const std::vector<std::string> keys{"pass", "id", "inputs"};
    return keys;
}

Graph::Graph(const Registry& registry, const Value& passList) : impl_(std::make_unique<Impl>()) {
    impl_->nodes = wireGraph(registry, passList, reservedKeys());
    impl_->memory.resize(impl_->nodes.size());
}

Graph::~Graph() = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;

std::vector<Graph::PassInfo> Graph::passes() const {
    std::vector<PassInfo> infos;
    for (const GraphNode& node : impl_->nodes)
        infos.push_back(
            {node.id, node.kind, node.phase, node.pass->warmupFrames(), node.where, node.lightRays});
    return infos;
}

void Graph::checkReadsLast(const std::string& output, const std::string& input) const {
    const GraphNode *lastWriter = nullptr, *reader = nullptr;
    const Resource *lastWritten = nullptr, *read = nullptr;
    bool reads = false;
    for (const GraphNode& node : impl_->nodes)
        for (size_t p = 0; p < node.ports.size(); ++p) {
            if (!node.ports[p].output) continue;
            if (node.ports[p].name == input) lastWriter = &node, lastWritten = node.resources[p];
            if (node.ports[p].name == output) reader = &node;
        }
    if (!lastWriter || !reader) return;
    for (size_t p = 0; p < reader->ports.size(); ++p)
        if (!reader->ports[p].output && reader->ports[p].name == input) {
            reads = true;
            read = reader->resources[p];
        }
    const Value* inputs = reader->resolved.find("inputs");
    if (!reads || read == lastWritten || (inputs && inputs->find(input))) return;
    throw UsageError(lastWriter->where,
                     "{0}: writes '{1}', but that is not what '{2}' reads, so '{3}' lacks what it brings: "
                     "put '{0}' right before '{2}', or choose with inputs of '{2}'",
                     lastWriter->id, input, reader->id, output);
}

std::vector<Graph::Input> Graph::unboundInputs(const std::string& portName) const {
    const auto writes = [&](const GraphNode& node) { return outputNamed(node, portName).has_value(); };
    const auto& nodes = impl_->nodes;
    const auto last = std::find_if(nodes.rbegin(), nodes.rend(), writes);
    std::vector<Input> inputs;
    for (size_t p = 0; last != nodes.rend() && p < last->ports.size(); ++p)
        if (!last->ports[p].output && !last->resources[p])
            inputs.push_back({last->id, last->ports[p].name, last->where});
    return inputs;
}

std::string Graph::whyCulled(const std::string& id) const {
    return voxray::whyCulled(impl_->nodes, id);
}

std::vector<std::string> Graph::cullUnused(const std::vector<std::string>& portNames) {
    std::vector<GraphNode>& nodes = impl_->nodes;
    const Needed needed = neededFor(nodes, portNames);
    std::vector<GraphNode> kept;
    std::vector<std::string> dropped;
    for (size_t n = 0; n < nodes.size(); ++n) {
        if (!needed.nodes[n]) {
            dropped.push_back(nodes[n].id);
            continue;
        }
        for (const std::unique_ptr<Resource>& output : nodes[n].outputs)
            output->isRead = needed.read.contains(output.get());
        kept.push_back(std::move(nodes[n]));
    }
    nodes = std::move(kept);
    impl_->memory.assign(nodes.size(), {});
    return dropped;
}

std::vector<std::string> Graph::noiseParameters(const std::string& portName) const {
    const auto& nodes = impl_->nodes;
    std::vector<std::string> paths;
    if (!writes(portName)) return paths;
    const Needed needed = neededFor(nodes, {portName});
    for (size_t n = 0; n < nodes.size(); ++n)
        if (needed.nodes[n])
            for (const std::string& name : nodes[n].noiseParameters)
                paths.push_back(nodes[n].id + "." + name);
    return paths;
}

std::vector<std::pair<std::string, std::vector<Aov>>> Graph::aovs() const {
    std::vector<std::pair<std::string, std::vector<Aov>>> byPass;
    for (const GraphNode& node : impl_->nodes) {
        std::vector<Aov> aovs;
        for (const std::unique_ptr<Resource>& output : node.outputs)
            for (const Aov& aov : output->aovs())
                if (*aov.image) aovs.push_back(aov);  // Null where no pass reads it.
        if (!aovs.empty()) byPass.emplace_back(node.id, std::move(aovs));
    }
    return byPass;
}

Value Graph::resolved() const {
    Value list = Value::list();
    for (const GraphNode& node : impl_->nodes) list.items.push_back(node.resolved);
    return list;
}

std::vector<UnusedSetting> Graph::unused() const {
    std::vector<UnusedSetting> parameters;
    for (const GraphNode& node : impl_->nodes)
        for (const UnusedSetting& parameter : node.unused)
            parameters.push_back({node.id + "." + parameter.name, parameter.where, parameter.why});
    return parameters;
}

bool Graph::writes(const std::string& portName) const {
    for (const GraphNode& node : impl_->nodes)
        for (const PortInfo& port : node.ports)
            if (port.output && port.name == portName) return true;
    return false;
}

std::vector<PassMemory> Graph::plan(const Frame& frame, const DeviceInfo& device, uint64_t memoryLimitBytes) {
    impl_->memoryLimitBytes = memoryLimitBytes;
    std::vector<PassMemory> memory;
    std::string largest;
    const GraphNode* largestPass = nullptr;
    uint64_t largestBytes = 0;
    for (size_t n = 0; n < impl_->nodes.size(); ++n) {
        GraphNode& node = impl_->nodes[n];
        PassPlan plan(*node.pass, node.resources, frame, device, node.phase);
        try {
            node.pass->plan(plan);
        } catch (const Error& error) {
            throw Error(node.where, "{}", error.what());
        }
        node.lightRays = plan.lightRays;
        impl_->memory[n] = PassMemoryTracker(plan);
        memory.push_back(impl_->memory[n].planned());

        for (const MemoryPlan::Allocation& allocation : plan.allocations()) {
            if (allocation.bytes <= largestBytes) continue;
            largestBytes = allocation.bytes;
            largest = node.id + "'s " + allocation.name;
            largestPass = &node;
        }
    }
    if (const uint64_t peak = peakBytes(memory); peak > memoryLimitBytes)
        throw Error(largestPass->where,
                    "the graph needs {:.1f} MiB, the limit is {:.1f} MiB; "
                    "the largest part is {} with {:.1f} MiB: {}",
                    double(peak) / kMiB, double(memoryLimitBytes) / kMiB, largest,
                    double(largestBytes) / kMiB, sizeAdvice(impl_->nodes, *largestPass));
    return memory;
}

void Graph::prepare(const Frame& frame, Device& device, const ShaderCompiler& compiler,
                    CommandStream& stream) {
    const MemoryLimit limit(device, impl_->memoryLimitBytes, 0);
    impl_->finiteCheck.emplace(device);
    if (!device.isHost()) {
        impl_->black = Image(device, "black", ImageDesc{});
        stream.clear(impl_->black, {});
        std::vector<PassProgram*> programs = impl_->finiteCheck->programs();
        for (const GraphNode& node : impl_->nodes)
            programs.insert(programs.end(), node.pass->programs().begin(), node.pass->programs().end());
        compile(programs, device, compiler);
    }
    for (size_t n = 0; n < impl_->nodes.size(); ++n) {
        GraphNode& node = impl_->nodes[n];
        PassSetup setup(node.resources, frame, device, stream);
        impl_->withSizeAdvice(node,
                              [&] { impl_->memory[n].prepare(stream, [&] { node.pass->prepare(setup); }); });
    }
}

std::vector<PassSample> Graph::run(Phase phase, const Frame& frame, Device& device, CommandStream& stream,
                                   RayTracer& tracer, const GpuScene& scene, uint32_t frameIndex,
                                   bool checkFinite) {
    struct PassTimestamps {
        size_t sample;
        uint32_t begin, end;
        std::vector<const Buffer*> voxelCounts;
    };
    std::vector<PassSample> samples;
    std::vector<PassTimestamps> timestamps;
    const MemoryLimit limit(device, impl_->memoryLimitBytes, impl_->usedBytes());
    stream.finish();
    stream.resetTimestamps();
    for (size_t n = 0; n < impl_->nodes.size(); ++n) {
        GraphNode& node = impl_->nodes[n];
        if (node.phase != phase) continue;
        const uint64_t raysBefore = tracer.raysTraced();

        // Device timestamps; host work of the Embree backend falls between them.
        PassContext context(node.resources, node.seenVersions ? &*node.seenVersions : nullptr, frame, device,
                            stream, tracer, scene, impl_->black, frameIndex);
        const StreamCounts before = stream.counts();
        uint32_t begin = 0, end = 0;
        const auto record = [&] {
            stream.beginLabel(node.id);
            begin = stream.timestamp();
            node.pass->record(context);
            end = stream.timestamp();
            stream.endLabel();
        };
        impl_->withSizeAdvice(node, [&] { impl_->memory[n].record(stream, record); });
        updateVersions(node, context.outputsUnchanged());

        PassSample sample;
        sample.rays = tracer.raysTraced() - raysBefore + context.extraRays;
        sample.work = stream.counts() - before;
        sample.reported = std::move(context.reported);
        for (const PassContext::Value& value : sample.reported)
            if (!std::isfinite(value.value))
                throw Error("pass '{}' reported {} as '{}'", node.id, value.value, value.name);
        timestamps.push_back({samples.size(), begin, end, std::move(context.voxelCounts)});
        samples.push_back(sample);
        if (checkFinite) impl_->checkOutputs(node, stream);
    }
    stream.finish();
    for (const PassTimestamps& s : timestamps) {
        PassSample& sample = samples[s.sample];
        sample.milliseconds = stream.millisecondsBetween(s.begin, s.end);
        uint64_t visits = 0;
        for (const Buffer* counts : s.voxelCounts) {
            const std::vector<uint64_t> stepsAndVisits = stream.readAs<uint64_t>(*counts, 2);
            sample.voxelSteps += stepsAndVisits[0];
            visits += stepsAndVisits[1];
        }
        if (!s.voxelCounts.empty()) sample.reported.push_back({"voxel visits", double(visits)});
    }
    return samples;
}

void Graph::Impl::withSizeAdvice(const GraphNode& node, const std::function<void()>& work) const {
    try {
        work();
    } catch (const SizeError& error) {
        throw Error(node.where, "{}: {}: {}", node.id, error.what(), sizeAdvice(nodes, node));
    }
}

void Graph::Impl::checkOutputs(const GraphNode& node, CommandStream& stream) {
    size_t output = 0;
    for (const PortInfo& port : node.ports) {
        if (!port.output) continue;
        const Resource& resource = *node.outputs[output++];
        for (const Image* image : resource.checkedImages()) {
            if (!*image) continue;
            if (const uint32_t bad = finiteCheck->badTexels(stream, *image))
                throw Error("pass '{}' wrote NaN or infinity to '{}' ({}, {} texels)", node.id, port.name,
                            image->name(), bad);
        }
        for (const Buffer* buffer : resource.checkedBuffers()) {
            if (!*buffer) continue;
            if (const uint32_t bad = finiteCheck->badFloats(stream, *buffer))
                throw Error("pass '{}' wrote NaN or infinity to '{}' ({}, {} values)", node.id, port.name,
                            buffer->name(), bad);
        }
    }
}

std::vector<PassMemory> Graph::memory() const {
    std::vector<PassMemory> memory;
    for (const PassMemoryTracker& pass : impl_->memory) memory.push_back(pass.used());
    return memory;
}

const Resource* Graph::find(const std::string& portName, std::type_index type) const {
    const Resource* found = nullptr;
    for (const GraphNode& node : impl_->nodes) {
        size_t output = 0;
        for (const PortInfo& port : node.ports) {
            if (!port.output) continue;
            const Resource* resource = node.outputs[output++].get();
            if (port.name == portName && port.type == type) found = resource;
        }
    }
    return found;
}

}  // namespace voxray

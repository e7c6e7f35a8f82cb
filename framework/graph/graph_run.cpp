#include <algorithm>
#include <cmath>

#include "base/byte_units.h"
#include "graph/graph.h"
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

/// Unless a phase ends, its passes count as never run: what they recorded may not have been executed.
class PhaseRun {
 public:
    PhaseRun(std::vector<GraphNode>& nodes, Phase phase) : nodes_(nodes), phase_(phase) {}
    ~PhaseRun() {
        if (hasEnded_) return;
        for (GraphNode& node : nodes_)
            if (node.phase == phase_ && !node.isReused) node.seenVersions.reset();
    }
    PhaseRun(const PhaseRun&) = delete;
    PhaseRun& operator=(const PhaseRun&) = delete;
    void end() { hasEnded_ = true; }

 private:
    std::vector<GraphNode>& nodes_;
    const Phase phase_;
    bool hasEnded_ = false;
};

/// Increments the versions of the outputs, and records which versions of all resources the pass has seen.
void updateVersions(GraphNode& node, bool outputsUnchanged) {
    if (!outputsUnchanged)
        for (const std::unique_ptr<Resource>& output : node.outputs) ++output->version;
    node.seenVersions.emplace();
    for (const Resource* resource : node.resources) node.seenVersions->push_back(resource ? resource->version : 0);
}

bool reads(const GraphNode& reader, const GraphNode& writer) {
    return std::ranges::any_of(
        writer.outputs, [&](const auto& output) { return std::ranges::count(reader.resources, output.get()) > 0; });
}

/// Advice for a pass that takes too much memory: its integer parameters and those of the passes that it
/// reads, unless without effect or at their minimum, and the image's size.
std::string sizeAdvice(const std::vector<GraphNode>& nodes, const GraphNode& node) {
    std::string paths;
    const auto add = [&](const GraphNode& other) {
        for (const std::string& parameter : other.sizeParameters) paths += fmt::format("{}.{}, ", other.id, parameter);
    };
    add(node);
    for (const GraphNode& writer : nodes)
        if (&writer != &node && reads(node, writer)) add(writer);
    return fmt::format("lower what it grows with, of {}image.width, image.height", paths);
}

}  // namespace

std::vector<PassMemory> Graph::plan(const Frame& frame, const DeviceInfo& device, uint64_t memoryLimitBytes) {
    memoryLimitBytes_ = memoryLimitBytes;
    std::vector<PassMemory> memory;
    std::string largest;
    const GraphNode* largestPass = nullptr;
    uint64_t largestBytes = 0;
    for (GraphNode& node : nodes_) {
        if (node.isReused) {
            memory.push_back(node.memory.planned());
            continue;
        }
        PassPlan plan(*node.pass, node.resources, frame, device, node.phase);
        try {
            node.pass->plan(plan);
        } catch (const Error& error) {
            throw Error(node.where, "{}", error.what());
        }
        node.lightRays = plan.lightRays;
        node.memory = PassMemoryTracker(plan);
        memory.push_back(node.memory.planned());
        for (const MemoryPlan::Allocation& allocation : plan.allocations()) {
            if (allocation.bytes <= largestBytes) continue;
            largestBytes = allocation.bytes;
            largest = node.id + "'s " + allocation.name;
            largestPass = &node;
        }
    }
    if (const uint64_t peak = peakBytes(memory); peak > memoryLimitBytes)
        throw Error(largestPass->where,
                    "the graph needs {:.1f} MiB, the limit is {:.1f} MiB; the largest part is {} with {:.1f} MiB: {}",
                    double(peak) / kMiB, double(memoryLimitBytes) / kMiB, largest, double(largestBytes) / kMiB,
                    sizeAdvice(nodes_, *largestPass));
    return memory;
}

void Graph::prepare(const Frame& frame, Device& device, const ShaderCompiler& compiler, CommandStream& stream) {
    const MemoryLimit limit(device, memoryLimitBytes_, reusedBytes());
    finiteCheck_ = std::make_unique<FiniteCheck>(device);
    if (!device.isHost()) {
        black_ = Image(device, "black", ImageDesc{});
        stream.clear(black_, {});
        std::vector<PassProgram*> programs = finiteCheck_->programs();
        for (const GraphNode& node : nodes_)
            programs.insert(programs.end(), node.pass->programs().begin(), node.pass->programs().end());
        compile(programs, device, compiler);
    }
    for (GraphNode& node : nodes_) {
        if (node.isReused) continue;
        PassSetup setup(*node.pass, node.resources, frame, device, stream);
        withSizeAdvice(node, [&] { node.memory.prepare(stream, [&] { node.pass->prepare(setup); }); });
    }
}

std::vector<PassSample> Graph::run(Phase phase, const Frame& frame, Device& device, CommandStream& stream,
                                   RayTracer& tracer, const GpuScene& scene, uint32_t frameIndex, bool checkFinite) {
    /// Timestamps and counters of a pass, which are read when all passes have run.
    struct Pending {
        uint32_t begin, end;
        std::vector<const Buffer*> marchCounters;
        std::optional<PassContext::ToldTime> toldTime;
        GraphNode* node;
    };
    std::vector<Pending> pending;
    uint64_t usedBytes = 0;
    for (const GraphNode& node : nodes_) usedBytes += node.memory.used().bytes;
    const MemoryLimit limit(device, memoryLimitBytes_, usedBytes);
    stream.finish();
    stream.resetTimestamps();
    PhaseRun phaseRun(nodes_, phase);
    const auto recordPass = [&](GraphNode& node) {
        const uint64_t raysBefore = tracer.raysTraced();

        // Device timestamps; host work of the Embree backend falls between them.
        PassContext context(*node.pass, node.resources, node.seenVersions, frame, device, stream, tracer, scene, black_,
                            frameIndex);
        const StreamCounts before = stream.counts();
        uint32_t begin = 0, end = 0;
        const auto record = [&] {
            stream.beginLabel(node.id);
            begin = stream.timestamp();
            node.pass->record(context);
            end = stream.timestamp();
            stream.endLabel();
        };
        withSizeAdvice(node, [&] { node.memory.record(stream, record); });
        updateVersions(node, context.outputsUnchanged());

        PassSample& sample = node.lastSample = {};
        sample.rays = tracer.raysTraced() - raysBefore + context.extraRays;
        sample.work = stream.counts() - before;
        sample.reported = std::move(context.reported);
        for (const PassContext::Value& value : sample.reported)
            if (!std::isfinite(value.value))
                throw Error("pass '{}' reported {} as '{}'", node.id, value.value, value.name);
        pending.push_back({begin, end, std::move(context.marchCounters), std::move(context.toldTime), &node});
        if (checkFinite) checkFiniteOutputs(node, stream);
    };
    try {
        for (GraphNode& node : nodes_)
            if (node.phase == phase && !node.isReused && !node.isSkipped) recordPass(node);
        finiteCheck_->finish(stream);
    } catch (const Error&) {
        finiteCheck_->abandon();  // What failed may have read NaN
        throw;
    }
    stream.finish();
    for (const auto& [begin, end, marchCounters, toldTime, node] : pending) {
        PassSample& sample = node->lastSample;
        sample.milliseconds = toldTime ? toldTime->milliseconds : stream.millisecondsBetween(begin, end);
        if (toldTime) sample.clock = toldTime->clock;
        uint64_t visits = 0;
        for (const Buffer* counts : marchCounters) {
            const std::vector<uint64_t> stepsAndVisits = stream.readAs<uint64_t>(*counts, 2);
            sample.voxelSteps += stepsAndVisits[0];
            visits += stepsAndVisits[1];
        }
        if (!marchCounters.empty()) sample.reported.push_back({"voxel visits", double(visits)});
    }
    phaseRun.end();
    std::vector<PassSample> samples;
    for (const GraphNode& node : nodes_)
        if (node.phase == phase) samples.push_back(node.lastSample);
    return samples;
}

void Graph::withSizeAdvice(const GraphNode& node, const std::function<void()>& work) const {
    try {
        work();
    } catch (const SizeError& error) {
        throw Error(node.where, "{}: {}: {}", node.id, error.what(), sizeAdvice(nodes_, node));
    }
}

void Graph::checkFiniteOutputs(const GraphNode& node, CommandStream& stream) {
    for (size_t p = 0; p < node.ports.size(); ++p) {
        const PortInfo& port = node.ports[p];
        if (!port.output) continue;
        const std::string what = fmt::format("pass '{}' wrote NaN or infinity to '{}'", node.id, port.name);
        const Resource& resource = *node.resources[p];
        for (const Image* image : resource.checkedImages())
            if (*image) finiteCheck_->count(stream, *image, what);
        for (const Buffer* buffer : resource.checkedBuffers())
            if (*buffer) finiteCheck_->count(stream, *buffer, what);
    }
}

uint64_t Graph::reusedBytes() const {
    uint64_t bytes = 0;
    for (const GraphNode& node : nodes_)
        if (node.isReused) bytes += node.memory.used().bytes;
    return bytes;
}

std::vector<PassMemory> Graph::memory() const {
    std::vector<PassMemory> memory;
    for (const GraphNode& node : nodes_) memory.push_back(node.memory.used());
    return memory;
}

}  // namespace voxray

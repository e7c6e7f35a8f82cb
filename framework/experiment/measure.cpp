#include "experiment/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/interrupt.h"
#include "graph/warmup.h"

namespace voxray {
namespace {

/// Timings of the passes of a phase over its repeats.
class PhaseSamples {
 public:
    void add(const std::vector<PassSample>& run) {
        byPass_.resize(run.size());
        double sum = 0;
        for (size_t i = 0; i < run.size(); ++i) {
            byPass_[i].push_back(run[i].milliseconds);
            sum += run[i].milliseconds;
        }
        sums_.push_back(sum);
        if (first_.empty()) first_ = run;
    }
    Percentiles sum() const { return percentiles(sums_); }
    PassCost cost(size_t pass) const {
        PassCost cost;
        if (pass >= first_.size()) return cost;
        cost.milliseconds = percentiles(byPass_[pass]);
        cost.rays = first_[pass].rays;
        cost.voxelSteps = first_[pass].voxelSteps;
        cost.work = first_[pass].work;
        cost.clock = first_[pass].clock;
        return cost;
    }

 private:
    std::vector<std::vector<double>> byPass_;
    std::vector<double> sums_;
    std::vector<PassSample> first_;
};

PassSample timeOnHost(CommandStream& stream, const std::function<void()>& work) {
    stream.finish();
    const StreamCounts before = stream.counts();
    const auto start = std::chrono::steady_clock::now();
    work();
    stream.finish();
    PassSample sample;
    sample.work = stream.counts() - before;
    sample.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return sample;
}

}  // namespace

Percentiles percentiles(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double fraction) {
        const double position = fraction * double(values.size() - 1);
        const size_t below = size_t(position), above = std::min(below + 1, values.size() - 1);
        return values[below] + (values[above] - values[below]) * (position - double(below));
    };
    return {at(0.05), at(0.5), at(0.95)};
}

Measurement measureGraph(Graph& graph, const GraphTarget& target, const MeasureSettings& settings,
                         const std::function<void(double)>& progress,
                         const std::function<void(const Frame&, uint32_t)>& afterFrame) {
    const double runsOfFrame = target.goToFrame ? 2 : 1;
    const double steps = 1 + settings.buildRepeats + runsOfFrame * (double(settings.warmup) + settings.frames);
    double done = 0;
    Frame frame = target.frame;
    frame.progress = [&](double part) {
        progress((done + part) / steps);
        return !interruptRequested();
    };
    const auto run = [&](Phase phase, uint32_t frameIndex, bool checkFinite) {
        if (interruptRequested()) throw Interrupted();
        auto samples =
            graph.run(phase, frame, target.device, target.stream, target.tracer, target.scene, frameIndex, checkFinite);
        if (interruptRequested()) throw Interrupted();
        progress(++done / steps);
        return samples;
    };

    Measurement result;
    const auto storeValues = [&](Phase phase, std::optional<uint32_t> frameIndex,
                                 const std::vector<PassSample>& samples) {
        auto sample = samples.begin();
        for (const Graph::PassInfo& pass : graph.passes())
            if (pass.phase == phase)
                for (const PassContext::Value& v : (sample++)->reported)
                    result.values.push_back({pass.id, v.name, frameIndex, v.value});
    };

    // Build: a first run with checks, then timed ones. Without repeats the first run is timed
    PhaseSamples build, frames;
    std::vector<PassSample> last = run(Phase::Build, 0, true);
    if (settings.buildRepeats == 0) build.add(last);
    for (uint32_t i = 0; i < settings.buildRepeats; ++i) build.add(last = run(Phase::Build, 0, false));
    storeValues(Phase::Build, std::nullopt, last);

    // Frames: the first measured one is compared
    const auto runFrame = [&](int fromCompared, uint32_t frameIndex, bool checkFinite) {
        const bool measured = fromCompared >= 0;
        frame.camera = target.frame.camera;
        std::vector<PassSample> samples;
        if (target.goToFrame) {
            samples.push_back(timeOnHost(target.stream, [&] { target.goToFrame(frame, fromCompared); }));
            const auto updates = run(Phase::Build, 0, checkFinite);
            if (measured) storeValues(Phase::Build, frameIndex, updates);
            samples.insert(samples.end(), updates.begin(), updates.end());
        }
        if (frame.moveCamera) frame.moveCamera(frame.camera, fromCompared);
        const auto frameSamples = run(Phase::Frame, frameIndex, checkFinite);
        if (measured) storeValues(Phase::Frame, frameIndex, frameSamples);
        samples.insert(samples.end(), frameSamples.begin(), frameSamples.end());
        return samples;
    };
    for (uint32_t i = 0; i < settings.warmup; ++i)
        runFrame(int(i) - int(settings.warmup), kFirstWarmupFrame + i, false);
    for (uint32_t i = 0; i < settings.frames; ++i) {
        const bool isChecked = target.checksFrames && (i == 0 || i + 1 == settings.frames);
        frames.add(runFrame(int(i), i, isChecked));
        afterFrame(frame, i);
    }

    // Costs of each pass, in the graph's order. A pass with two costs has its memory in the first one
    const auto addCost = [&](PassCost cost, const std::string& id, Phase phase, const PassMemory& memory) {
        cost.id = id;
        cost.phase = phase;
        cost.memoryBytes = memory.bytes;
        cost.scratchBytes = memory.scratchBytes;
        result.memoryBytes += memory.bytes;
        result.rays += cost.rays;
        result.passes.push_back(cost);
    };
    const std::vector<PassMemory> memory = graph.memory();
    const std::vector<Graph::PassInfo> passes = graph.passes();
    size_t nextBuild = 0, nextUpdate = 0;
    if (target.goToFrame) addCost(frames.cost(nextUpdate++), kSceneUpdate, Phase::Frame, {});
    size_t nextFrame = nextUpdate;
    if (target.goToFrame)
        for (const Graph::PassInfo& pass : passes) nextFrame += pass.phase == Phase::Build;
    for (size_t i = 0; i < passes.size(); ++i) {
        const bool isBuild = passes[i].phase == Phase::Build;
        addCost(isBuild ? build.cost(nextBuild++) : frames.cost(nextFrame++), passes[i].id, passes[i].phase, memory[i]);
        if (isBuild && target.goToFrame) addCost(frames.cost(nextUpdate++), passes[i].id, Phase::Frame, {});
    }
    result.peakBytes = peakBytes(memory);
    result.buildMs = build.sum().median;
    result.frameMs = frames.sum();
    return result;
}

}  // namespace voxray

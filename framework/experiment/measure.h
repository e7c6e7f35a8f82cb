#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "graph/graph.h"
#include "image/image.h"

namespace voxray {

/// Distribution of repeated timings.
struct Percentiles {
    double p05 = 0;
    double median = 0;
    double p95 = 0;
};
/// Interpolates linearly between the sorted values. Without values all are 0.
Percentiles percentiles(std::vector<double> values);

/// The cost of a pass.
struct PassCost {
    std::string id;
    Phase phase = Phase::Frame;
    Percentiles milliseconds;
    uint64_t rays = 0;          ///< In one run.
    uint64_t voxelSteps = 0;    ///< In one run.
    uint64_t memoryBytes = 0;   ///< Persistent.
    uint64_t scratchBytes = 0;  ///< Additional memory while it runs.
    StreamCounts work = {};     ///< In one run.
    std::string clock{};        ///< Who measured the time, in words; empty: the device's time stamps.
};

/// A number that a pass reported.
struct ReportedValue {
    std::string pass;
    std::string name;
    std::optional<uint32_t> frame;  ///< Index of the measured frame; nullopt: reported in the build.
    double value = 0;
};

/// Costs and reported values of one variant.
struct Measurement {
    std::vector<PassCost> passes;
    std::vector<ReportedValue> values;  ///< Values of the last build, then of the measured frames.
    double buildMs = 0;                 ///< Median of the build passes' sum.
    Percentiles frameMs;                ///< Times of all frame passes and the updates before them.
    uint64_t memoryBytes = 0;           ///< Persistent memory of the passes, without the scene.
    uint64_t peakBytes = 0;             ///< The same with the largest scratch memory of a pass.
    uint64_t rays = 0;                  ///< In one build and one frame.
    double tracerBuildMs = 0;           ///< Of the scene's tracer: SceneOnDevice.
    uint64_t tracerBytes = 0;           ///< RayTracer::memoryBytes()
};

/// Everything that a graph needs to run.
struct GraphTarget {
    const Frame& frame;
    Device& device;
    CommandStream& stream;
    RayTracer& tracer;
    const GpuScene& scene;
    /// Updates scene, tracer and the frame's camera and `changed` to another frame, whose index is relative
    /// to the compared one. Empty: only the camera moves.
    std::function<void(Frame&, int)> goToFrame;
    bool checksFrames = true;  ///< Whether outputs of measured frames are checked for NaN and infinity.
};

/// The time of GraphTarget::goToFrame is recorded as that of a pass with this name.
inline constexpr const char* kSceneUpdate = "scene";

/// Runs a prepared graph: the build passes once untimed and then `buildRepeats` times (with 0 repeats the
/// first run is timed), then warm-up frames and measured frames. Measured frames have indices from 0, warm-up
/// frames from 1,000,000, so that frame 0 does not depend on the number of measured frames. From frame to
/// frame the camera moves by Frame::moveCamera. If the target has `goToFrame`, it and the build passes run before
/// the passes of each frame, and build passes have a second cost, of phase Frame. They use the random numbers
/// of frame 0 each time, so that only moving surfaces and lights make a difference. Outputs are checked for
/// NaN and infinity, outside of the timings, in the first build and in the first and last measured frame.
/// @param progress is called with the fraction done.
/// @param afterFrame is called outside of the timings with each measured frame and its index, to read images.
/// @throws Interrupted, Error of a pass.
Measurement measureGraph(Graph& graph, const GraphTarget& target, const MeasureSettings& settings,
                         const std::function<void(double)>& progress,
                         const std::function<void(const Frame&, uint32_t)>& afterFrame);

}  // namespace voxray

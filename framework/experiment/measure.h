#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "graph/graph.h"
#include "image/image.h"

namespace voxray {

/// Spread of repeated timings.
struct Percentiles {
    double p05 = 0;
    double median = 0;
    double p95 = 0;
};
/// Linear interpolation between the sorted values; zeros for none.
Percentiles percentiles(std::vector<double> values);

/// What one pass cost.
struct PassCost {
    std::string id;
    Phase phase = Phase::Frame;
    Percentiles milliseconds;
    uint64_t rays = 0;          ///< In one run.
    uint64_t voxelSteps = 0;    ///< In one run.
    uint64_t memoryBytes = 0;   ///< That it keeps.
    uint64_t scratchBytes = 0;  ///< That it takes besides while it runs.
    StreamCounts work = {};     ///< In one run.
};

/// A number that a pass reported.
struct ReportedValue {
    std::string pass;
    std::string name;
    std::optional<uint32_t> frame;  ///< Measured frame, from 0; none in the build.
    double value = 0;
};

/// What one variant cost and made.
struct Measurement {
    std::vector<PassCost> passes;
    std::vector<ReportedValue> values;  ///< Of the last build, then of the measured frames.
    double buildMs = 0;                 ///< Median of the build passes' sum.
    Percentiles frameMs;       ///< Of the frame passes' sum, with all that is brought up to date before them.
    uint64_t memoryBytes = 0;  ///< Kept by the passes; the scene itself is not counted.
    uint64_t peakBytes = 0;    ///< The same with the scratch of the pass that takes most.
    uint64_t rays = 0;         ///< Of one build and one frame.
};

/// What a graph runs on.
struct GraphTarget {
    const Frame& frame;
    Device& device;
    CommandStream& stream;
    RayTracer& tracer;
    const GpuScene& scene;
    /// Takes scene, tracer and the frame's camera and `changed` to a frame, counted from the compared one;
    /// empty: only the camera moves.
    std::function<void(Frame&, int)> goToFrame;
};

/// The pass under whose name the time of GraphTarget::goToFrame stands.
inline constexpr const char* kSceneUpdate = "scene";

/// Runs a prepared graph: the build passes once untimed and then `buildRepeats` times (with 0 repeats the
/// first run is timed), warm-up frames,
/// measured frames. Measured frames are numbered from 0, warm-up frames from 1,000,000, so that frame 0 does
/// not depend on how many frames are measured. A frame's camera stands as many times
/// `cameraMove` from the target frame's as the frame is after frame 0. Where the target has `goToFrame`, it
/// and the build passes run before the passes of each frame, and build passes have a second cost, of phase
/// Frame. They always run as in frame 0: they draw the same random numbers each time, so that only what
/// changed changes. Outputs are checked for NaN and infinity, outside of the timings, in the first build and
/// in the first and last measured frame.
/// @param progress called with the fraction done.
/// @param afterFrame called outside of the timings with each measured frame and its number, to read images.
/// @throws Interrupted, Error of a pass.
Measurement measureGraph(Graph& graph, const GraphTarget& target, const MeasureSettings& settings,
                         const std::function<void(double)>& progress,
                         const std::function<void(const Frame&, uint32_t)>& afterFrame);

/// Level 0 of an RGBA32F image; alpha is dropped.
ImageF downloadImage(Device& device, CommandStream& stream, const Image& image);

}  // namespace voxray

#pragma once

#include "passes/common/lights/pane_transmittance.h"
#include "passes/path_trace/path_streams/device_lights.h"
#include "passes/path_trace/path_streams/path_types.h"
#include "passes/path_trace/path_tracer.h"

namespace voxray {

/// Paths of a batch of samples, one stream of rays a vertex (a wavefront: Laine et al. 2013, "Megakernels
/// Considered Harmful"; here one kernel shades all materials, and no new path takes the place of one that ended).
/// Shading lists the rays of the paths that go on, packed, so that paths that ended cost nothing. The device counts
/// the rays; tracers that run there take the counts from it, without the host.
class PathStreams {
 public:
    explicit PathStreams(ProgramOwner& owner);

    /// @param paths maximum of a batch.
    void plan(PassPlan& plan, const PathTraceOptions& options, uint32_t paths);
    /// Clears the number of rays of a frame.
    void begin(PassContext& context);
    /// Traces a batch of paths from the frame's camera.
    void trace(PassContext& context, const gpu::PathBatch& batch);
    /// Empties the lists for a batch of paths that begin at their second vertex, the hits of rays that leave what the
    /// camera sees. @return bindings of the caller's shader that lists them (begin_path.glsl), for follow().
    std::vector<Binding> open(PassContext& context);
    /// Traces the listed paths on. Neither emission at their first hits nor what is before these counts.
    void follow(PassContext& context, const gpu::PathBatch& batch) { traceFrom(context, batch, 1); }
    /// Rays of all batches since begin(), with those to the first hits of listed paths; waits for the device.
    uint64_t rays(PassContext& context);

    /// gpu::PathSums of each path of the last batch.
    const Buffer& sums() const { return sums_; }

 private:
    /// Rays with the light that arrives along them.
    struct LitRays {
        Buffer rays, lights;
        void plan(PassPlan& plan, const char* name, uint32_t paths);
    };

    /// Adds the last batch's rays to those of the frame, and clears the lists for one of so many camera paths.
    void startBatch(PassContext& context, uint32_t paths);
    void count(PassContext& context, uint32_t paths, bool isFirst);
    /// Shades vertices, the first of which the paths' rays have hit, and traces the rays between them.
    void traceFrom(PassContext& context, const gpu::PathBatch& batch, uint32_t firstVertex);
    void shade(PassContext& context, const gpu::PathBatch& batch, uint32_t vertex);
    void addShadowed(PassContext& context, uint32_t vertex);
    void addSeenThroughPanes(PassContext& context, uint32_t vertex);
    /// Waits for the device. @return the length of a stream of a vertex.
    uint32_t length(PassContext& context, uint32_t vertex, uint32_t stream) const;
    void dim(PassContext& context, const LitRays& lit, uint32_t vertex, uint32_t stream) const;
    bool isOver(PassContext& context, uint32_t vertex) const;

    DeviceLights lights_;
    PaneTransmittance panes_;
    Kernel count_, generate_, shade_, shadePanes_, addShadowed_, addSeen_;
    uint32_t vertices_ = 0, paths_ = 0;
    bool hasPanes_ = false, clearsCounts_ = false;
    Buffer rays_[2], pathVertices_[2];  ///< Of a vertex and of the next one.
    Buffer hits_, occluded_, sums_;
    LitRays shadows_, seen_;
    Buffer counts_;  ///< gpu::StreamCount: STREAMS for each vertex.
    Buffer traced_;  ///< Rays of all batches, one number of 64 bits.
};

}  // namespace voxray

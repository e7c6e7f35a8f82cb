#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "scene/geometry.h"
#include "trace/ray.h"
#include "vulkan/commands.h"
#include "vulkan/device.h"
#include "vulkan/memory.h"

namespace voxray {

enum class TracerKind { Auto, RayQuery, RayPipeline, Embree };

/// Traces streams of rays. Buffers hold at least `count` elements: Ray (32 bytes), and Hit (16 bytes) or
/// uint32_t (1: occluded, 0: not). Calls are recorded into the command stream; the Embree backend submits the
/// recorded commands, waits and traces on the CPU.
class RayTracer {
 public:
    virtual ~RayTracer() = default;

    /// "ray_query", "ray_pipeline" or "embree".
    virtual std::string_view name() const = 0;
    /// @throws Error if a buffer is too small; with `embree` also for the first ray that is not finite.
    void closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, uint32_t count,
                    Coherence coherence = Coherence::Incoherent);
    void occluded(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
                  Coherence coherence = Coherence::Incoherent);
    /// Rebuilds the moving instances from the state's current positions (`advance`).
    void update(CommandStream& stream);
    /// Bytes of acceleration structures, without those of panes.
    virtual size_t memoryBytes() const = 0;

    /// Rays traced since construction.
    uint64_t raysTraced() const { return raysTraced_ + (panes_ ? panes_->raysTraced() : 0); }
    /// Tracer of the panes that dim light (scene/panes.h), which this tracer doesn't hit; nullptr: there are
    /// none.
    RayTracer* panes() const { return panes_.get(); }
    void setPanes(std::unique_ptr<RayTracer> panes) { panes_ = std::move(panes); }

 protected:
    virtual void updateStructure(CommandStream& stream) = 0;
    enum class Query { ClosestHit, Occluded };
    /// Buffer sizes are checked.
    virtual void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
                       Coherence coherence) = 0;

 private:
    uint64_t raysTraced_ = 0;
    std::unique_ptr<RayTracer> panes_;
};

/// Resolves `auto`: ray_query on a GPU that has it, ray_pipeline on a GPU with ray pipelines only, else
/// embree.
TracerKind resolveTracer(TracerKind wanted, const Device& device);

/// A tracer of the state's surfaces, and of its panes if they dim light. `state` must outlive the tracer.
/// @throws Error naming a feature that the device lacks.
std::unique_ptr<RayTracer> makeRayTracer(TracerKind kind, Device& device, ShaderCompiler& compiler,
                                         const SceneState& state);

}  // namespace voxray

#pragma once

#include <functional>

#include "trace/embree_scene.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Traces streams on the CPU: in place if buffers are mapped, else through staged copies.
class EmbreeTracer final : public RayTracer {
 public:
    explicit EmbreeTracer(const SceneState& state) : scene_(state) {}
    std::string_view name() const override { return "embree"; }

    size_t memoryBytes() const override { return scene_.memoryBytes(); }

 private:
    void updateStructure(CommandStream& stream) override;
    /// @throws Error naming the first ray that is not finite.
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) override;
    template <typename Result>
    void trace(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
               const std::function<void(std::span<const Ray>, std::span<Result>)>& traceRays);

    EmbreeScene scene_;
};

}  // namespace voxray

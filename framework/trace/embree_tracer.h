#pragma once

#include <functional>

#include "trace/embree_scene.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Streams on the CPU: on the buffers themselves where they are mapped, else through copies in parts.
class EmbreeTracer final : public RayTracer {
 public:
    explicit EmbreeTracer(const SceneState& state) : scene_(state) {}
    std::string_view name() const override { return "embree"; }

    /// @throws Error naming the first ray that is not finite.
    void closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, uint32_t count) override;
    void occluded(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count) override;
    void update(CommandStream& stream) override;
    size_t memoryBytes() const override { return scene_.memoryBytes(); }

 private:
    template <typename Result>
    void trace(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
               void (EmbreeScene::*function)(std::span<const Ray>, std::span<Result>) const);

    EmbreeScene scene_;
};

}  // namespace voxray

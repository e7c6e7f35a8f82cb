#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "scene/geometry.h"
#include "trace/ray.h"

namespace voxray {

/// What a BVH is built for: a good one takes several times as long to build.
enum class RaysToCome { Many, Few };

/// A scene's triangles in an Embree BVH, and a second one of those that move, with alpha masks honoured on
/// every ray. Embree's headers stay out of this one (embree_bvh.h). Rays may come from any thread, but not
/// during an update.
class EmbreeScene {
 public:
    /// `state` must outlive this object. @throws Error where Embree refuses (out of memory).
    explicit EmbreeScene(const SceneState& state, RaysToCome rays = RaysToCome::Many);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;

    /// Takes over where the state's moving instances are now (`advance`). @throws Error where Embree refuses.
    void update();

    /// One ray. The ray must be finite with tMin >= 0 (checked by the callers that take rays from outside).
    Hit closestHit(const Ray& ray) const;
    bool occluded(const Ray& ray) const;

    /// Up to kPacketRays rays that lie close together, as one by one but in less time. Those with tMax < tMin
    /// hit nothing.
    static constexpr size_t kPacketRays = 8;
    void closestHitPacket(std::span<const Ray> rays, std::span<Hit> hits) const;
    void occludedPacket(std::span<const Ray> rays, std::span<uint32_t> results) const;

    /// Whole streams, on all cores; `result` is 1 where something lies between tMin and tMax.
    /// @throws Error naming the index of the first ray that is NaN, infinite (a tMax of +inf is allowed),
    /// beyond 1.8e18 m or has a negative tMin; inactive rays too.
    void closestHit(std::span<const Ray> rays, std::span<Hit> hits,
                    Coherence coherence = Coherence::Incoherent) const;
    void occluded(std::span<const Ray> rays, std::span<uint32_t> results,
                  Coherence coherence = Coherence::Incoherent) const;

    /// Bytes that Embree holds: its BVH and its copy of the triangles.
    size_t memoryBytes() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace voxray

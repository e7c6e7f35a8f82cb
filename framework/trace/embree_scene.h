#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "scene/geometry.h"
#include "trace/ray.h"

namespace voxray {

/// Number of rays that a BVH is built for: one of high quality takes several times as long to build.
enum class ExpectedRays { Many, Few };

/// A scene's triangles in Embree, with alpha masks on all rays. Doesn't include Embree's headers
/// (embree_bvh.h). Thread-safe except during update().
class EmbreeScene {
 public:
    /// `state` must outlive this object. @throws Error if Embree is out of memory.
    explicit EmbreeScene(const SceneState& state, ExpectedRays rays = ExpectedRays::Many);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;

    /// Rebuilds dynamic triangles from the state's current positions (`advance`). @throws Error if Embree is
    /// out of memory.
    void update();

    /// The ray must be finite with tMin >= 0, which is not checked.
    Hit closestHit(const Ray& ray) const;
    bool occluded(const Ray& ray) const;

    /// Up to kPacketRays coherent rays, with the results of single rays but faster. Inactive rays (tMax <
    /// tMin) hit nothing.
    static constexpr size_t kPacketRays = 16;
    void closestHitPacket(std::span<const Ray> rays, std::span<Hit> hits) const;
    void occludedPacket(std::span<const Ray> rays, std::span<uint32_t> results) const;

    /// Streams of rays, on all cores. `results`: 1 if occluded between tMin and tMax.
    /// @throws Error with the index of the first ray, active or not, that is NaN, infinite (a tMax of +inf is
    /// allowed), beyond 1.8e18 m or has a negative tMin.
    void closestHit(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence = Coherence::Incoherent) const;
    void occluded(std::span<const Ray> rays, std::span<uint32_t> results,
                  Coherence coherence = Coherence::Incoherent) const;

    /// Bytes of Embree's BVHs and its copy of the triangles.
    size_t memoryBytes() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace voxray

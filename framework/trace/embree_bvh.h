#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/geometry.h"
#include "trace/embree_api.h"

namespace voxray {

/// A scene's triangles in Embree: a BVH over those that stay, with all of the scene's vertices, and one over
/// those that move, with theirs. Alpha masks hold for every kind of ray. For EmbreeScene alone, since this
/// header brings Embree's.
struct EmbreeBvh {
    /// Triangles that share how they are intersected. Embree's primitive i is the scene's triangle ids[i].
    struct TriangleGroup {
        std::vector<uint32_t> ids;
        std::vector<uint32_t> skipped;  ///< By primitive: vertices before its own that Embree lacks.
        const SceneState* state = nullptr;
    };

    struct Part {
        RTCScene scene = nullptr;
        TriangleGroup opaque, masked;       ///< Embree's geometries 0 and 1.
        std::vector<InstanceRange> moving;  ///< Whose vertices there are; none: all.
        bool sameNumbers = false;           ///< Embree's primitive numbers are the scene's.

        uint32_t triangleOf(const RTCHit& hit) const {
            return sameNumbers ? hit.primID : (hit.geomID == 0 ? opaque : masked).ids[hit.primID];
        }
    };

    EmbreeBvh() = default;
    ~EmbreeBvh();
    EmbreeBvh(const EmbreeBvh&) = delete;
    EmbreeBvh& operator=(const EmbreeBvh&) = delete;

    /// Once. `state` must outlive this object. The qualities are those of `still` and of `moving`.
    /// @throws Error where Embree refuses (out of memory), Interrupted.
    void build(const SceneState& state, RTCBuildQuality ofStill, RTCBuildQuality ofMoving);
    /// Takes over where the state's moving instances are now. @throws as build().
    void update();

    RTCDevice device = nullptr;
    Part still, moving;  ///< `moving` has a scene only where something moves.
    std::atomic<ptrdiff_t> bytes{0};

 private:
    /// Sorts the triangles into parts that stay and move, and those into opaque and alpha-masked ones.
    void sort(const SceneState& state);
    void buildPart(Part& part, RTCBuildQuality quality);
    /// Adds the group's triangles to a part as geometry number `geomId`.
    void attach(const Part& part, TriangleGroup& group, unsigned geomId, RTCBuildQuality quality);
    /// Copies the group's vertices and corners as they are now.
    void fill(const Part& part, const TriangleGroup& group, unsigned geomId);
    void commit(const Part& part);
};

}  // namespace voxray

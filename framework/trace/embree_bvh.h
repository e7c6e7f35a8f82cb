#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/geometry.h"
#include "trace/embree_api.h"

namespace voxray {

/// A scene's triangles in Embree: a BVH of static triangles, with all of the scene's vertices, and one of
/// dynamic triangles, with theirs. Alpha masks apply to all rays. For EmbreeScene alone, since it includes
/// Embree's headers.
struct EmbreeBvh {
    /// Opaque or alpha-masked triangles. Embree's primitive i is the scene's triangle ids[i].
    struct TriangleGroup {
        std::vector<uint32_t> ids;
        std::vector<uint32_t> vertexOffsets;  ///< Scene's vertex index less Embree's, per primitive; empty: 0.
        const SceneState* state = nullptr;
    };

    struct Bvh {
        RTCScene scene = nullptr;
        TriangleGroup opaque, masked;          ///< Embree's geometries 0 and 1.
        std::vector<InstanceRange> instances;  ///< Instances whose vertices it has; empty: all.
        bool idsAreIdentity = false;           ///< Embree's primitives are the scene's triangles.

        uint32_t triangleOf(const RTCHit& hit) const {
            return idsAreIdentity ? hit.primID : (hit.geomID == 0 ? opaque : masked).ids[hit.primID];
        }
    };

    EmbreeBvh() = default;
    ~EmbreeBvh();
    EmbreeBvh(const EmbreeBvh&) = delete;
    EmbreeBvh& operator=(const EmbreeBvh&) = delete;

    /// Called once. `state` must outlive this object. @throws Error if Embree is out of memory, Interrupted.
    void build(const SceneState& state, RTCBuildQuality staticQuality, RTCBuildQuality dynamicQuality);
    /// Rebuilds the dynamic BVH from the state's current positions. @throws as build().
    void update();

    RTCDevice device = nullptr;
    Bvh staticBvh, dynamicBvh;  ///< `dynamicBvh` has a scene only if something moves.
    std::atomic<ptrdiff_t> bytes{0};

 private:
    /// Sorts the triangles into static and dynamic, opaque and alpha-masked ones.
    void sort(const SceneState& state);
    void buildBvh(Bvh& bvh, RTCBuildQuality quality);
    /// Adds the group's triangles to a BVH as geometry `geomId`.
    void attach(const Bvh& bvh, TriangleGroup& group, unsigned geomId, RTCBuildQuality quality);
    /// Copies the group's current vertices and indices.
    void fill(const Bvh& bvh, const TriangleGroup& group, unsigned geomId);
    void commit(const Bvh& bvh);
};

}  // namespace voxray

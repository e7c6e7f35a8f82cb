#pragma once

#include <vector>

#include "graph/pass.h"
#include "shaders/hybrid_leaves/hybrid_types.h"

namespace voxray {

/// What the leaves of the octree over surface voxels hold: lists of triangles (Seok 2021, section 3.1).
/// Leaves are numbered as surface voxels are; the octree's structure is its users' (VoxelMarch). GLSL access:
/// shaders/hybrid_leaves/hybrid_leaves.glsl.
struct HybridLeaves : Resource {
    gpu::HybridShape shape{};
    uint64_t version = 0;         ///< Another one whenever the content is.
    uint32_t primitiveCount = 0;  ///< Words of all lists.
    Buffer header;                ///< Addresses of the arrays, and `shape`.
    Buffer words;                 ///< A word a leaf.
    Buffer primitives;            ///< Triangles' numbers, list by list; at least one word.

    std::vector<Binding> bindings() const { return {ifUsed({"hybridLeaves", header})}; }
    uint64_t structureBytes() const { return header.bytes() + words.bytes(); }
    uint64_t listBytes() const { return primitives.bytes(); }
};

}  // namespace voxray

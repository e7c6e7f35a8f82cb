#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// Light of the voxel faces that a frame's gather rays hit, and of those that their light comes from. Other faces
/// have no value. GLSL access: passes/cache/hit_faces/hit_face_light.glsl.
struct HitFaceLight : Resource {
    std::string indexedBy() const override { return "voxels"; }

    LargeBuffer numbers;  ///< uint by face, 6 a voxel: number among the lit faces, or NO_FACE.
    Buffer irradiance;  ///< vec4 by number, W/m², direct and indirect; w: 1 where lit, else 0. May have room for more.

    /// Whether a face keeps its number from frame to frame, until `generation` changes. Known from plan() on.
    bool keepsNumbers = false;
    uint64_t generation = 0;

    /// For shaders that include hit_face_light.glsl.
    std::vector<Binding> bindings() const {
        return {{"FaceNumbersRef", numbers.ref()}, ifUsed({"hitFaceIrradiance", irradiance})};
    }
};

}  // namespace voxray

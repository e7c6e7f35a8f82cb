#pragma once

#include "vulkan/program.h"

namespace voxray {

/// What the faces are by which hits are grouped (hit_face.glsl): those of surface voxels, or the cells of a
/// RadianceCache.
enum class FaceKind { Voxels, Cells };

/// For shaders that include hit_face.glsl.
inline Defines definesOf(FaceKind kind, Defines more = {}) {
    if (kind == FaceKind::Cells) more["CACHE_CELLS"] = "1";
    return more;
}

}  // namespace voxray

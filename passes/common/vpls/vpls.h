#pragma once

#include "graph/pass.h"
#include "shaders/vpls/vpl_types.h"

namespace voxray {

/// Virtual point lights (Keller 1997): all of the scene's indirect light, up to a number of bounces, sent
/// from points. GLSL: shaders/vpls/vpl_types.h.
struct Vpls : Resource {
    uint32_t paths = 0;     ///< Paths of light that they are the vertices of; known from plan() on.
    float areaPerPath = 0;  ///< Of all surfaces, m²; known from plan() on.
    uint32_t bounces = 0;   ///< Vertices of a path, at most; known from plan() on.
    Buffer points;  ///< gpu::Vpl each, some of them without flux: vertices of paths that ended before.
    Buffer list;  ///< Numbers of those with flux, in order; hit b of the path in place p has p × bounces + b.
    uint32_t count = 0;  ///< Of `list`; known once the sampling pass has run.

    std::vector<const Buffer*> checkedBuffers() const override { return {&points}; }
};

}  // namespace voxray

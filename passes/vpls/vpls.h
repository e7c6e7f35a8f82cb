#pragma once

#include "base/error.h"
#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/vpls/vpl_types.h"

namespace voxray {

/// Virtual point lights (Keller 1997): all of the scene's indirect light, up to a number of bounces, sent
/// from points. GLSL: passes/vpls/vpls.glsl.
struct Vpls : Resource {
    uint32_t paths = 0;     ///< Paths of light that they are the vertices of, or the number of lights that a
                            ///< selection keeps, each a path of its own; known from plan() on.
    float areaPerPath = 0;  ///< Surface for each light of a bounce, m²; known from plan() on.
    uint32_t bounces = 0;   ///< Vertices of a path, at most; known from plan() on.
    LargeBuffer points;  ///< gpu::Vpl each, some of them without flux: vertices of paths that ended before.
    Buffer list;  ///< Numbers of those with flux, in order; hit b of the path in place p has p × bounces + b.
    uint32_t count = 0;  ///< Of `list`; known once the sampling pass has run.

    std::vector<const Buffer*> checkedBuffers() const override { return {&points}; }

    /// Places of `points` and, at most, of `list`. @throws Error where a list of them is more than a buffer
    /// may be on any device.
    uint64_t places(const char* pass) const {
        constexpr uint64_t kMaxBytes = 128u << 20;  // What Vulkan guarantees of maxStorageBufferRange.
        const uint64_t count = uint64_t(paths) * bounces, bytes = count * sizeof(uint32_t);
        if (bytes > kMaxBytes)
            throw Error(
                "{}: a list of {} paths of up to {} virtual lights takes {} MiB, a buffer at most 128; lower "
                "the one or the other",
                pass, paths, bounces, bytes >> 20);
        return count;
    }
};

}  // namespace voxray

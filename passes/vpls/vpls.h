#pragma once

#include "base/error.h"
#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/vpls/vpl_types.h"

namespace voxray {

/// Virtual point lights (Keller 1997) for the scene's indirect light of up to `bounces` bounces: the vertices
/// of light paths. Vertex b of path p has the index p * bounces + b. Members but the last are known from
/// plan() on. GLSL: passes/vpls/vpls.glsl.
struct Vpls : Resource {
    uint32_t paths = 0;        ///< After select_vpls: the most lights that it selects, each a path by itself.
    uint32_t bounces = 0;      ///< Maximum vertices of a path.
    float areaPerPath = 0;     ///< Surface area over the number of lights of a bounce, m².
    LargeBuffer points;        ///< gpu::Vpl each; flux is 0 for vertices that a path did not reach.
    Buffer activeIndices;      ///< Indices of the points with flux, ascending.
    uint32_t activeCount = 0;  ///< Of `activeIndices`; known once sample_vpls has recorded.

    std::vector<const Buffer*> checkedBuffers() const override { return {&points}; }
    std::vector<Elements> elements() const override {
        return {{&points, Elements::Type::Float32, sizeof(gpu::Vpl) / sizeof(float)}};
    }

    /// Number of `points`, and the most that `activeIndices` can have. @throws Error where a buffer of these
    /// indices would exceed maxStorageBufferRange of some device.
    uint64_t capacity(const char* pass) const {
        constexpr uint64_t kMaxBytes = 128u << 20;  // What Vulkan guarantees of maxStorageBufferRange.
        const uint64_t vertices = uint64_t(paths) * bounces, bytes = vertices * sizeof(uint32_t);
        if (bytes > kMaxBytes)
            throw Error(
                "{}: a list of {} paths of up to {} virtual lights takes {} MiB, a buffer at most 128; "
                "lower the one or the other",
                pass, paths, bounces, bytes >> 20);
        return vertices;
    }
};

}  // namespace voxray

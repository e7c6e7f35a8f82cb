#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/cache/radiance_cache_types.h"

namespace voxray {

/// Irradiance of surfaces, by cells of a world-space grid that are the larger the farther they are from the
/// camera, and by normal. Cells lie in a hash table. Sums are 64-bit fixed point: the same bits in any order.
/// Which slot a cell has may depend on the order; what it holds does not, while every cell finds a slot. GLSL
/// access: passes/cache/radiance_cache.glsl. Source: Binder et al. 2019 (path space filtering by
/// hashing); NVIDIA's SHaRC.
struct RadianceCache : Resource {
    gpu::RadianceCacheGrid grid{};
    Buffer gridBuffer;  ///< The same, on the device.
    Buffer keys;        ///< uint64_t a slot, 0: empty.
    Buffer sums;        ///< 4 uint64_t a slot: irradiance of all samples, and their number.

    static constexpr uint64_t kKeyBytes = sizeof(uint64_t), kSumBytes = 4 * sizeof(uint64_t);
    /// What a shader binds that includes radiance_cache.glsl.
    std::vector<Binding> bindings() const {
        return {ifUsed({"radianceCacheGrid", gridBuffer}), ifUsed({"radianceCacheKeys", keys}),
                ifUsed({"radianceCacheSums", sums})};
    }
};

}  // namespace voxray

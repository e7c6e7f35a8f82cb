#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/cache/radiance_cache_types.h"

namespace voxray {

/// Irradiance of surfaces in the cells of a world-space grid, which grow with the distance from the camera,
/// and by normal. Cells are stored in a hash table. Sums are 64-bit fixed point, so they do not depend on the
/// order of threads; a cell's slot may, but its values do not as long as every cell finds a slot. GLSL
/// access: passes/cache/radiance_cache.glsl. Source: Binder et al. 2019 (path space filtering by hashing);
/// NVIDIA's SHaRC.
struct RadianceCache : Resource {
    Buffer gridBuffer;  ///< gpu::RadianceCacheGrid
    Buffer keys;        ///< uint64_t a slot; 0: empty.
    Buffer sums;        ///< 4 uint64_t a slot: irradiance of all samples, and their number.

    std::vector<Elements> elements() const override {
        return {{&keys, Elements::Type::Uint64, 1}, {&sums, Elements::Type::Uint64, 4}};
    }

    static constexpr uint64_t kKeyBytes = sizeof(uint64_t), kSumBytes = 4 * sizeof(uint64_t);
    /// For shaders that include radiance_cache.glsl.
    std::vector<Binding> bindings() const {
        return {ifUsed({"radianceCacheGrid", gridBuffer}), ifUsed({"radianceCacheKeys", keys}),
                ifUsed({"radianceCacheSums", sums})};
    }
};

}  // namespace voxray

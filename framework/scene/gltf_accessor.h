#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf_file.h"

namespace voxray {

/// Values of an accessor as floats, `components` per element.
struct AccessorValues {
    size_t count = 0;
    uint32_t components = 0;
    std::vector<float> data;

    /// Component of an element, or the fallback if elements are shorter.
    float get(size_t element, uint32_t component, float fallback = 0) const {
        return component < components ? data[element * components + component] : fallback;
    }
};

/// Reads an accessor of any component type, with stride, sparse substitution and normalisation.
/// @param minComponents,maxComponents accepted shapes: 1 scalar ... 4 vec4, 16 mat4
/// @param forceNormalized integers are normalized even if the file doesn't say so
/// @throws Error if it is out of bounds of its buffer.
AccessorValues readAccessor(GltfFile& file, int accessor, uint32_t minComponents, uint32_t maxComponents,
                            const char* what, bool forceNormalized = false);

/// Reads vertex indices (8, 16 or 32 bits). @throws Error
std::vector<uint32_t> readIndices(GltfFile& file, int accessor);

}  // namespace voxray

#include "scene/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace voxray {
namespace {

/// Limit of accessors without a buffer, which are zeros: a few bytes of JSON can declare any number of them.
constexpr size_t maxZeros = size_t(1) << 22;

/// Elements in a buffer, checked to be inside of it.
struct Elements {
    const uint8_t* data = nullptr;
    size_t stride = 0;

    const uint8_t* at(size_t index) const { return data + index * stride; }
};

uint32_t componentBytes(const GltfFile& file, int type) {
    const int bytes = tinygltf::GetComponentSizeInBytes(uint32_t(type));
    if (bytes < 0 || type == TINYGLTF_COMPONENT_TYPE_INT || type == TINYGLTF_COMPONENT_TYPE_DOUBLE)
        file.fail("component type {} is not one of glTF's", type);
    return uint32_t(bytes);
}

uint32_t componentCount(const GltfFile& file, int type, const char* what) {
    const int count = tinygltf::GetNumComponentsInType(uint32_t(type));
    if (count < 0 || type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3)
        file.fail("{} can't be matrices of 2 or 3 columns", what);
    return uint32_t(count);
}

/// @throws Error if an element ends outside of the view, or the view outside of its buffer.
Elements locate(const GltfFile& file, int viewIndex, int64_t byteOffset, size_t count, size_t elementBytes,
                bool strided, const char* what) {
    const tinygltf::BufferView& view = file.at(file.model().bufferViews, viewIndex, "bufferView");
    const tinygltf::Buffer& buffer = file.at(file.model().buffers, view.buffer, "buffer");
    if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
        file.fail("bufferView {} ends outside of its buffer", viewIndex);
    const size_t stride = strided && view.byteStride > 0 ? view.byteStride : elementBytes;
    const bool inside = byteOffset >= 0 && elementBytes <= view.byteLength &&
                        size_t(byteOffset) <= view.byteLength - elementBytes &&
                        (count == 0 || count - 1 <= (view.byteLength - elementBytes - size_t(byteOffset)) / stride);
    if (!inside)
        file.fail("{}: {} elements of {} bytes end outside of bufferView {}, which has {} bytes", what, count,
                  elementBytes, viewIndex, view.byteLength);
    return {buffer.data.data() + view.byteOffset + byteOffset, stride};
}

template <typename T>
T load(const uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// One integer as a number, or as a fraction (glTF 2.0, section 3.11.1).
template <typename T>
float convert(const uint8_t* bytes, bool normalized) {
    const T value = load<T>(bytes);
    if (!normalized) return float(value);
    return std::max(float(double(value) / double(std::numeric_limits<T>::max())), -1.0f);
}

float loadFloat(const uint8_t* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return convert<int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return convert<uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return convert<int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return convert<uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return convert<uint32_t>(bytes, normalized);
        default:
            return load<float>(bytes);
    }
}

uint32_t loadIndex(const uint8_t* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<uint16_t>(bytes);
        default:
            return load<uint32_t>(bytes);
    }
}

void checkIndexType(const GltfFile& file, int type) {
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        file.fail("indices have component type {}; unsigned 8, 16 or 32 bits are expected", type);
}

/// Calls visit(index, bytes) for all elements of the buffer and of the sparse part; others are zeros.
/// @throws Error if an element is out of bounds.
template <typename Visit>
void visitElements(const GltfFile& file, const tinygltf::Accessor& accessor, size_t elementBytes, const char* what,
                   const Visit& visit) {
    if (accessor.bufferView >= 0) {
        if (accessor.byteOffset > size_t(std::numeric_limits<int64_t>::max()))
            file.fail("{}: byteOffset {} is too big", what, accessor.byteOffset);
        const Elements elements =
            locate(file, accessor.bufferView, int64_t(accessor.byteOffset), accessor.count, elementBytes, true, what);
        for (size_t i = 0; i < accessor.count; ++i) visit(i, elements.at(i));
    }
    if (!accessor.sparse.isSparse) return;
    const auto& sparse = accessor.sparse;
    checkIndexType(file, sparse.indices.componentType);
    if (sparse.count < 0 || size_t(sparse.count) > accessor.count)
        file.fail("{}: {} sparse values for {} elements", what, sparse.count, accessor.count);
    const size_t count = size_t(sparse.count);
    const Elements indices = locate(file, sparse.indices.bufferView, sparse.indices.byteOffset, count,
                                    componentBytes(file, sparse.indices.componentType), false, what);
    const Elements values =
        locate(file, sparse.values.bufferView, sparse.values.byteOffset, count, elementBytes, false, what);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t index = loadIndex(indices.at(i), sparse.indices.componentType);
        if (index >= accessor.count) file.fail("{}: sparse index {} of {}", what, index, accessor.count);
        visit(index, values.at(i));
    }
}

/// Checks the number of elements against the available bytes, before allocation.
void checkCount(GltfFile& file, const tinygltf::Accessor& accessor, size_t elementBytes, const char* what) {
    if (accessor.bufferView < 0) {
        if (accessor.count > maxZeros)
            file.fail("{}: {} elements without a buffer; at most {} are allowed", what, accessor.count, maxZeros);
        return;
    }
    const tinygltf::BufferView& view = file.at(file.model().bufferViews, accessor.bufferView, "bufferView");
    const size_t step = view.byteStride > 0 ? view.byteStride : elementBytes;
    if (accessor.count > view.byteLength / step + 1)
        file.fail("{}: {} elements don't fit in bufferView {} of {} bytes", what, accessor.count, accessor.bufferView,
                  view.byteLength);
}

}  // namespace

AccessorValues readAccessor(GltfFile& file, int index, uint32_t minComponents, uint32_t maxComponents, const char* what,
                            bool forceNormalized) {
    const tinygltf::Accessor& accessor = file.at(file.model().accessors, index, "accessor");
    AccessorValues values;
    values.count = accessor.count;
    values.components = componentCount(file, accessor.type, what);
    if (values.components < minComponents || values.components > maxComponents)
        file.fail("{} has {} components per element, {} to {} are expected", what, values.components, minComponents,
                  maxComponents);
    const uint32_t bytes = componentBytes(file, accessor.componentType);
    checkCount(file, accessor, bytes * values.components, what);
    file.reserve(values.count, sizeof(float) * values.components);
    values.data.resize(values.count * values.components);
    const bool normalized = accessor.normalized || forceNormalized;
    visitElements(file, accessor, bytes * values.components, what, [&](size_t i, const uint8_t* element) {
        for (uint32_t c = 0; c < values.components; ++c)
            values.data[i * values.components + c] = loadFloat(element + c * bytes, accessor.componentType, normalized);
    });
    return values;
}

std::vector<uint32_t> readIndices(GltfFile& file, int index) {
    const char* what = "indices";
    const tinygltf::Accessor& accessor = file.at(file.model().accessors, index, "accessor");
    if (accessor.type != TINYGLTF_TYPE_SCALAR) file.fail("indices are not scalars");
    checkIndexType(file, accessor.componentType);
    const uint32_t bytes = componentBytes(file, accessor.componentType);
    checkCount(file, accessor, bytes, what);
    file.reserve(accessor.count, sizeof(uint32_t));
    std::vector<uint32_t> indices(accessor.count);
    visitElements(file, accessor, bytes, what,
                  [&](size_t i, const uint8_t* element) { indices[i] = loadIndex(element, accessor.componentType); });
    return indices;
}

}  // namespace voxray

#include <meshoptimizer.h>

#include "base/error.h"
#include "scene/gltf_compression.h"
#include "scene/gltf_json.h"

namespace voxray {
namespace {

using nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";

std::string textMember(const json& object, const char* key, const char* fallback) {
    const json value = object.value(key, json(fallback));
    if (!value.is_string()) throw Error("'{}' is not a string", key);
    return value;
}

/// Undoes the filter of decoded vertices, in place.
void unfilter(std::vector<uint8_t>& data, size_t count, size_t stride, const std::string& filter) {
    const bool fits = filter == "OCTAHEDRAL"    ? stride == 4 || stride == 8
                      : filter == "QUATERNION"  ? stride == 8
                      : filter == "EXPONENTIAL" ? stride % 4 == 0
                                                : filter == "NONE";
    if (!fits) throw Error("filter '{}' with a stride of {} bytes is not one of glTF's", filter, stride);
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(data.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(data.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(data.data(), count, stride);
}

std::vector<uint8_t> decoded(const json& view, const GltfBuffers& buffers, const ReserveMemory& reserve) {
    // Location and layout of the compressed bytes (EXT_meshopt_compression)
    const json& source = *extensionOf(view, kMeshopt);
    const uint64_t buffer = unsignedMember(source, "buffer", kMeshopt);
    const uint64_t offset = unsignedMember(source, "byteOffset", kMeshopt, 0);
    const uint64_t length = unsignedMember(source, "byteLength", kMeshopt);
    const uint64_t stride = unsignedMember(source, "byteStride", kMeshopt);
    const uint64_t count = unsignedMember(source, "count", kMeshopt);
    if (buffer >= buffers.size() || offset > buffers[buffer].size() || length > buffers[buffer].size() - offset)
        throw Error("its compressed bytes end outside of buffer {}", buffer);
    const std::string mode = textMember(source, "mode", "");
    const bool vertices = mode == "ATTRIBUTES";
    if (!vertices && mode != "TRIANGLES" && mode != "INDICES")
        throw Error("mode '{}' is not one of {}'s", mode, kMeshopt);
    const bool strideFits = vertices ? stride > 0 && stride % 4 == 0 && stride <= 256 : stride == 2 || stride == 4;
    if (!strideFits || (mode == "TRIANGLES" && count % 3 != 0))
        throw Error("{} elements of {} bytes can't be of mode {}", count, stride, mode);
    if (count > unsignedMember(view, "byteLength", "it") / stride)
        throw Error("{} elements of {} bytes don't fit in it", count, stride);

    reserve(count, stride);
    std::vector<uint8_t> data(size_t(count * stride));
    const uint8_t* bytes = buffers[buffer].data() + offset;
    int fault = 0;
    if (count > 0 && vertices)
        fault = meshopt_decodeVertexBuffer(data.data(), count, stride, bytes, length);
    else if (count > 0 && mode == "TRIANGLES")
        fault = meshopt_decodeIndexBuffer(data.data(), count, stride, bytes, length);
    else if (count > 0)
        fault = meshopt_decodeIndexSequence(data.data(), count, stride, bytes, length);
    if (fault != 0) throw Error("its {} data is broken", kMeshopt);
    if (vertices) unfilter(data, count, stride, textMember(source, "filter", "NONE"));
    return data;
}

}  // namespace

void expandMeshopt(json& root, GltfBuffers& buffers, const ReserveMemory& reserve) {
    const size_t count = objects(root, "bufferViews").size();
    for (size_t i = 0; i < count; ++i) {
        json& view = root["bufferViews"][i];
        if (extensionOf(view, kMeshopt) == nullptr) continue;
        try {
            std::vector<uint8_t> data = decoded(view, buffers, reserve);
            view["buffer"] = buffers.size();
            view["byteOffset"] = 0;
            view["byteLength"] = data.size();
            view["extensions"].erase(kMeshopt);
            buffers.push_back(std::move(data));
        } catch (const Error& error) {
            throw Error("bufferView {}: {}", i, error.what());
        }
    }
}

}  // namespace voxray

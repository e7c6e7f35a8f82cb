#include "scene/gltf_data.h"

#include "base/error.h"
#include "scene/gltf_json.h"
#include "scene/gltf_uri.h"

namespace voxray {
namespace {

using nlohmann::json;

/// The uri of a buffer or an image, or nullptr.
const std::string* uriOf(const json& object) {
    const auto entry = object.find("uri");
    if (entry == object.end()) return nullptr;
    if (!entry->is_string()) throw Error("its uri is not a string");
    return &entry->get_ref<const std::string&>();
}

std::vector<uint8_t> readBuffer(const GltfContainer& container, size_t index, uint64_t size,
                                const std::filesystem::path& folder) {
    const json& source = container.root["buffers"][index];
    std::vector<uint8_t> bytes;
    if (const std::string* uri = uriOf(source))
        bytes = readUri(*uri, folder);
    else if (container.binary && index == 0)
        bytes.assign(container.bin.begin(), container.bin.end());
    else if (const json* meshopt = extensionOf(source, "EXT_meshopt_compression");
             meshopt && meshopt->value("fallback", json()) == true)
        return {};
    else
        throw Error("it has no uri");
    if (bytes.size() < size) throw Error("its byteLength is {}, but it has {} bytes", size, bytes.size());
    bytes.resize(size);
    return bytes;
}

EncodedImage readImage(const json& root, size_t index, const GltfBuffers& buffers,
                       const std::filesystem::path& folder) {
    const json& source = root["images"][index];
    EncodedImage image;
    if (const auto name = source.find("name"); name != source.end() && name->is_string())
        image.name = name->get<std::string>();
    if (source.contains("bufferView")) {
        image.bytes = viewBytes(root, buffers, unsignedMember(source, "bufferView", "it"));
    } else if (const std::string* uri = uriOf(source)) {
        if (!isDataUri(*uri)) image.uri = *uri;
        if (isDataUri(*uri) || !findUri(*uri, folder).empty())
            image.bytes = readUri(*uri, folder);
        else
            image.fault = fmt::format("file '{}' is missing", *uri);
    } else {
        image.fault = "it has neither bufferView nor uri";
    }
    if (image.bytes.empty() && image.fault.empty()) image.fault = "it is empty";
    return image;
}

}  // namespace

GltfBuffers readBuffers(const GltfContainer& container, const std::filesystem::path& folder) {
    GltfBuffers buffers;
    const json& sources = objects(container.root, "buffers");
    for (size_t i = 0; i < sources.size(); ++i) {
        const uint64_t size = unsignedMember(sources[i], "byteLength", fmt::format("buffer {}", i));
        try {
            buffers.push_back(readBuffer(container, i, size, folder));
        } catch (const Error& error) {
            throw Error("buffer {}: {}", i, error.what());
        }
    }
    return buffers;
}

std::vector<EncodedImage> readImages(const json& root, const GltfBuffers& buffers,
                                     const std::filesystem::path& folder) {
    std::vector<EncodedImage> images;
    for (size_t i = 0; i < objects(root, "images").size(); ++i) try {
            images.push_back(readImage(root, i, buffers, folder));
        } catch (const Error& error) {
            throw Error("image {}: {}", i, error.what());
        }
    return images;
}

std::vector<uint8_t> viewBytes(const json& root, const GltfBuffers& buffers, uint64_t index) {
    const json& views = objects(root, "bufferViews");
    if (index >= views.size()) throw Error("bufferView {} is used, but is not there", index);
    const std::string what = fmt::format("bufferView {}", index);
    const uint64_t offset = unsignedMember(views[index], "byteOffset", what, 0);
    const uint64_t length = unsignedMember(views[index], "byteLength", what);
    const uint64_t buffer = unsignedMember(views[index], "buffer", what);
    if (buffer >= buffers.size() || offset > buffers[buffer].size() || length > buffers[buffer].size() - offset)
        throw Error("{} ends outside of its buffer", what);
    const auto begin = buffers[buffer].begin() + int64_t(offset);
    return {begin, begin + int64_t(length)};
}

}  // namespace voxray

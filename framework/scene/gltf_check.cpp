#include "scene/gltf_check.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace voxray {
namespace {

using nlohmann::json;

constexpr int maxDepth = 64;
constexpr uint64_t maxImageBytes = 0x7fffffff;

constexpr std::array supportedExtensions{"KHR_lights_punctual",  "KHR_materials_emissive_strength",
                                         "KHR_materials_ior",    "KHR_materials_specular",
                                         "KHR_materials_unlit",  "KHR_mesh_quantization",
                                         "KHR_texture_transform"};

uint32_t readU32(std::span<const uint8_t> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value |= uint32_t(bytes[offset + i]) << (8 * i);
    return value;
}

/// The JSON chunk of a .glb file, after every length was compared with the bytes that are there.
std::string_view jsonChunk(std::span<const uint8_t> file) {
    constexpr uint32_t jsonType = 0x4E4F534A;
    constexpr uint32_t binType = 0x004E4942;
    if (file.size() < 20) throw Error("the .glb header is cut off after {} bytes", file.size());
    if (const uint32_t version = readU32(file, 4); version != 2)
        throw Error(".glb version {} is not supported; convert it to glTF 2.0", version);
    const uint64_t length = readU32(file, 8);
    if (length > file.size())
        throw Error("truncated: the header promises {} bytes, the file has {}", length, file.size());
    std::string_view text;
    uint64_t offset = 12;
    for (size_t chunk = 0; offset + 8 <= length; ++chunk) {
        const uint64_t bytes = readU32(file, offset);
        const uint32_t type = readU32(file, offset + 4);
        offset += 8;
        if (bytes > length - offset) throw Error("truncated: chunk {} ends outside of the file", chunk);
        if (chunk == 0 && type != jsonType) throw Error("its first chunk is not JSON");
        if (chunk == 1 && type != binType) throw Error("its second chunk is not BIN");
        if (chunk == 0) text = {reinterpret_cast<const char*>(file.data()) + offset, size_t(bytes)};
        offset += bytes;
    }
    return text;
}

/// Parsers of values recurse: a file of brackets alone would overflow the stack.
void checkDepth(std::string_view text) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            inString = c != '"';
        } else if (c == '"') {
            inString = true;
        } else if (c == '[' || c == '{') {
            if (++depth > maxDepth) throw Error("its JSON is nested more than {} levels deep", maxDepth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

json parse(std::string_view text) {
    if (text.empty()) throw Error("it is empty");
    checkDepth(text);
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        // Without the name of the exception, which stands in brackets before what it says
        const std::string_view what = error.what();
        throw Error("its JSON is broken: {}", what.substr(what.find(' ') + 1));
    }
}

/// An array of objects at the top level; an empty one where the file has none.
const json& objects(const json& root, const char* key) {
    static const json none = json::array();
    const auto entry = root.find(key);
    if (entry == root.end()) return none;
    if (!entry->is_array()) throw Error("'{}' is not an array", key);
    for (const json& item : *entry)
        if (!item.is_object()) throw Error("'{}' has an entry that is not an object", key);
    return *entry;
}

/// A non-negative integer member. @throws Error where it is something else, or missing without a default.
uint64_t unsignedMember(const json& object, const char* key, const std::string& what, int64_t fallback = -1) {
    const auto entry = object.find(key);
    if (entry == object.end() && fallback >= 0) return uint64_t(fallback);
    if (entry == object.end() || !entry->is_number_unsigned())
        throw Error("{} needs '{}' as a non-negative integer", what, key);
    return entry->get<uint64_t>();
}

void checkUri(const json& object, const std::string& what) {
    const auto entry = object.find("uri");
    if (entry == object.end()) return;
    if (!entry->is_string()) throw Error("{}: its uri is not a string", what);
    const std::string& uri = entry->get_ref<const std::string&>();
    if (uri.empty()) throw Error("{}: its uri is empty", what);
    if (uri.starts_with("data:")) return;

    // Decode %xx, then look for whatever leaves the folder.
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
            std::isxdigit(static_cast<unsigned char>(uri[i + 2]))) {
            path += char(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    std::replace(path.begin(), path.end(), '\\', '/');
    const bool leaves = path.front() == '/' || path.find(':') != std::string::npos ||
                        path.find('\0') != std::string::npos ||
                        ("/" + path + "/").find("/../") != std::string::npos;
    if (leaves) throw Error("{}: uri '{}' is not a file below the scene's folder", what, uri);
}

void checkVersion(const json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version") ||
        !(*asset)["version"].is_string())
        throw Error("it has no asset.version, so it is not glTF");
    const std::string version = (*asset)["version"];
    if (!version.starts_with("2."))
        throw Error("glTF version '{}' is not supported; convert it to glTF 2.0", version);
}

std::vector<std::string> unknownExtensions(const json& root, const char* key) {
    std::vector<std::string> unknown;
    const auto entry = root.find(key);
    if (entry == root.end()) return unknown;
    if (!entry->is_array()) throw Error("'{}' is not an array", key);
    for (const json& item : *entry) {
        if (!item.is_string()) throw Error("'{}' has an entry that is not a string", key);
        const std::string name = item;
        if (std::find(supportedExtensions.begin(), supportedExtensions.end(), name) ==
            supportedExtensions.end())
            unknown.push_back(name);
    }
    return unknown;
}

void checkBuffers(const json& root, bool binary) {
    // Buffers and the views into them.
    const json& buffers = objects(root, "buffers");
    for (size_t i = 0; i < buffers.size(); ++i) {
        const std::string what = fmt::format("buffer {}", i);
        if (unsignedMember(buffers[i], "byteLength", what) == 0) throw Error("{} has no bytes", what);
        if (!buffers[i].contains("uri") && !(binary && i == 0)) throw Error("{} has no uri", what);
        checkUri(buffers[i], what);
    }
    const json& views = objects(root, "bufferViews");
    for (size_t i = 0; i < views.size(); ++i) {
        const std::string what = fmt::format("bufferView {}", i);
        const uint64_t buffer = unsignedMember(views[i], "buffer", what);
        if (buffer >= buffers.size()) throw Error("{} lies in buffer {}, which is not there", what, buffer);
        const uint64_t size = unsignedMember(buffers[buffer], "byteLength", what);
        const uint64_t offset = unsignedMember(views[i], "byteOffset", what, 0);
        const uint64_t length = unsignedMember(views[i], "byteLength", what);
        if (offset > size || length > size - offset)
            throw Error("{}: bytes {} + {} end outside of buffer {}, which has {}", what, offset, length,
                        buffer, size);
    }

    // Images in views or in files.
    const json& images = objects(root, "images");
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string what = fmt::format("image {}", i);
        checkUri(images[i], what);
        if (!images[i].contains("bufferView")) continue;
        const uint64_t view = unsignedMember(images[i], "bufferView", what);
        if (view >= views.size()) throw Error("{} lies in bufferView {}, which is not there", what, view);
        const uint64_t length = unsignedMember(views[view], "byteLength", what);
        if (length == 0 || length > maxImageBytes) throw Error("{} has a size of {} bytes", what, length);
    }
}

}  // namespace

GltfOutline checkGltf(std::span<const uint8_t> file) {
    GltfOutline outline;
    outline.binary = file.size() >= 4 && std::memcmp(file.data(), "glTF", 4) == 0;
    const std::string_view text =
        outline.binary ? jsonChunk(file)
                       : std::string_view(reinterpret_cast<const char*>(file.data()), file.size());
    const json root = parse(text);
    if (!root.is_object()) throw Error("its JSON is not an object, so it is not glTF");
    checkVersion(root);
    if (const auto unknown = unknownExtensions(root, "extensionsRequired"); !unknown.empty())
        throw Error("it requires the extension {}, which Voxray does not support; export it without",
                    unknown[0]);
    outline.unknownExtensions = unknownExtensions(root, "extensionsUsed");
    for (const char* key : {"accessors", "animations", "cameras", "materials", "meshes", "nodes", "samplers",
                            "scenes", "skins", "textures"})
        objects(root, key);
    checkBuffers(root, outline.binary);
    return outline;
}

}  // namespace voxray

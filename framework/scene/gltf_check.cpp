#include "scene/gltf_check.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.h"
#include "scene/gltf_json.h"

namespace voxray {
namespace {

using nlohmann::json;

/// Supported extensions. Those of variants and metadata don't affect rendering.
constexpr std::array supportedExtensions{"EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                         "EXT_texture_webp",        "KHR_draco_mesh_compression",
                                         "KHR_lights_punctual",     "KHR_materials_emissive_strength",
                                         "KHR_materials_ior",       "KHR_materials_pbrSpecularGlossiness",
                                         "KHR_materials_specular",  "KHR_materials_transmission",
                                         "KHR_materials_unlit",     "KHR_materials_variants",
                                         "KHR_mesh_quantization",   "KHR_node_visibility",
                                         "KHR_texture_basisu",      "KHR_texture_transform",
                                         "KHR_xmp_json_ld"};

/// The number before or after the dot of a version; -1 if missing.
int versionPart(std::string_view version, bool minor) {
    if (minor) version.remove_prefix(std::min(version.find('.'), version.size() - 1) + 1);
    int value = -1;
    std::from_chars(version.data(), version.data() + version.size(), value);
    return value;
}

void checkVersion(const json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version") || !(*asset)["version"].is_string())
        throw Error("it has no asset.version, so it is not glTF 2.0 (glTF 1.0 may lack it: convert it)");
    const std::string version = (*asset)["version"];
    if (!version.starts_with("2.")) throw Error("glTF version '{}' is not supported; convert it to glTF 2.0", version);
    const auto entry = asset->find("minVersion");
    if (entry == asset->end()) return;
    const std::string least = entry->is_string() ? entry->get<std::string>() : entry->dump();
    const int major = least.empty() ? -1 : versionPart(least, false);
    const int minor = least.empty() ? -1 : versionPart(least, true);
    if (major < 0 || minor < 0) throw Error("asset.minVersion is '{}'; expected a version, as 2.0", least);
    if (major > 2 || (major == 2 && minor > 0))
        throw Error("asset.minVersion says that it needs a reader of glTF {}; Voxray reads glTF 2.0", least);
}

std::vector<std::string> unknownExtensions(const json& root, const char* key) {
    std::vector<std::string> unknown;
    const auto entry = root.find(key);
    if (entry == root.end()) return unknown;
    if (!entry->is_array()) throw Error("'{}' is not an array", key);
    for (const json& item : *entry) {
        if (!item.is_string()) throw Error("'{}' has an entry that is not a string", key);
        const std::string name = item;
        if (std::find(supportedExtensions.begin(), supportedExtensions.end(), name) == supportedExtensions.end())
            unknown.push_back(name);
    }
    return unknown;
}

void checkViews(const json& root) {
    const json& buffers = objects(root, "buffers");
    const json& views = objects(root, "bufferViews");
    for (size_t i = 0; i < views.size(); ++i) {
        const std::string what = fmt::format("bufferView {}", i);
        const uint64_t buffer = unsignedMember(views[i], "buffer", what);
        if (buffer >= buffers.size()) throw Error("{} lies in buffer {}, which is not there", what, buffer);
        const uint64_t size = unsignedMember(buffers[buffer], "byteLength", fmt::format("buffer {}", buffer));
        const uint64_t offset = unsignedMember(views[i], "byteOffset", what, 0);
        const uint64_t length = unsignedMember(views[i], "byteLength", what);
        if (offset > size || length > size - offset)
            throw Error("{}: bytes {} + {} end outside of buffer {}, which has {}", what, offset, length, buffer, size);
    }
}

}  // namespace

std::vector<std::string> checkGltf(const json& root) {
    checkVersion(root);
    if (const auto unknown = unknownExtensions(root, "extensionsRequired"); !unknown.empty())
        throw Error("it requires the extension {}, which Voxray does not support; export it without",
                    fmt::join(unknown, ", "));
    std::vector<std::string> leftOut = unknownExtensions(root, "extensionsUsed");
    for (const char* key : {"accessors", "animations", "cameras", "images", "materials", "meshes", "nodes", "samplers",
                            "scenes", "skins", "textures"})
        objects(root, key);
    checkViews(root);
    return leftOut;
}

}  // namespace voxray

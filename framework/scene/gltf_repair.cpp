#include "scene/gltf_repair.h"

#include "base/error.h"
#include "scene/gltf_json.h"

namespace voxray {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

/// The entries of a top-level array.
json& entries(json& root, const char* key) {
    objects(root, key);
    json& array = root[key];
    if (array.is_null()) array = json::array();
    return array;
}

std::string nameOf(const json& object) {
    const auto name = object.find("name");
    return name != object.end() && name->is_string() ? oneLine(name->get<std::string>(), 100) : "";
}

/// Drops channels without a target node (glTF 2.0, section 5.5).
void dropChannelsWithoutNode(json& root, Lines& warnings) {
    json& animations = entries(root, "animations");
    for (size_t a = 0; a < animations.size(); ++a) {
        json kept = json::array();
        const json& channels = objects(animations[a], "channels");
        for (size_t c = 0; c < channels.size(); ++c) {
            const auto target = channels[c].find("target");
            if (target != channels[c].end() && target->is_object() && target->contains("node"))
                kept.push_back(channels[c]);
            else
                warnings.push_back(fmt::format("animation {} '{}': channel {} has no target node; left out", a,
                                               nameOf(animations[a]), c));
        }
        animations[a]["channels"] = std::move(kept);
    }
}

/// Missing inverse bind matrices are identities (glTF 2.0, section 5.28).
void allowSkinsWithoutMatrices(json& root) {
    for (json& skin : entries(root, "skins"))
        if (!skin.contains("inverseBindMatrices")) skin["inverseBindMatrices"] = -1;
}

/// Sets missing near planes, and parameters of orthographic cameras, which are unused.
void completeCameras(json& root) {
    for (json& camera : entries(root, "cameras")) {
        const auto perspective = camera.find("perspective");
        if (perspective != camera.end() && perspective->is_object() && !perspective->contains("znear"))
            (*perspective)["znear"] = 0.01;
        if (camera.value("type", json()) == "orthographic")
            camera["orthographic"] = {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}};
    }
}

/// Uses an extension's image if the core has no fallback image.
void nameImagesOfTextures(json& root) {
    for (json& texture : entries(root, "textures"))
        for (const char* extension : {"EXT_texture_webp", "KHR_texture_basisu"})
            if (const json* extended = extensionOf(texture, extension);
                extended && extended->contains("source") && !texture.contains("source"))
                texture["source"] = (*extended)["source"];
}

/// Converts diffuse and specular colour to a dielectric's base colour and reflectance at normal incidence,
/// 0.04 * specularColorFactor (KHR_materials_specular).
void rewriteSpecularGlossiness(json& root, Lines& warnings) {
    json& materials = entries(root, "materials");
    for (size_t i = 0; i < materials.size(); ++i) {
        const json* source = extensionOf(materials[i], "KHR_materials_pbrSpecularGlossiness");
        if (source == nullptr) continue;
        json core = {{"metallicFactor", 0}};
        if (source->contains("diffuseFactor")) core["baseColorFactor"] = (*source)["diffuseFactor"];
        if (source->contains("diffuseTexture")) core["baseColorTexture"] = (*source)["diffuseTexture"];
        json color = source->value("specularFactor", json{1, 1, 1});
        const json gloss = source->value("glossinessFactor", json(1));
        const std::string what = fmt::format("material {} '{}'", i, nameOf(materials[i]));
        if (!gloss.is_number() || !color.is_array())
            throw Error("{}: its KHR_materials_pbrSpecularGlossiness is broken", what);
        if (source->contains("specularGlossinessTexture")) {
            warnings.push_back(what + ": specularGlossinessTexture is left out; it is taken as rough");
        } else {
            core["roughnessFactor"] = 1 - gloss.get<double>();
            for (json& value : color)
                if (value.is_number()) value = value.get<double>() / 0.04;
            materials[i]["extensions"]["KHR_materials_specular"] = {{"specularColorFactor", color}};
        }
        materials[i]["pbrMetallicRoughness"] = std::move(core);
    }
}

}  // namespace

Lines repairGltf(json& root) {
    Lines warnings;
    dropChannelsWithoutNode(root, warnings);
    allowSkinsWithoutMatrices(root);
    completeCameras(root);
    nameImagesOfTextures(root);
    rewriteSpecularGlossiness(root, warnings);
    return warnings;
}

}  // namespace voxray

// Materials of an exported scene, with their textures.
#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "scene/gltf_export.h"

namespace voxray {
namespace {

tinygltf::Value number(double value) {
    return tinygltf::Value(value);
}

template <typename Vector>
tinygltf::Value array(const Vector& v) {
    tinygltf::Value::Array out;
    for (int i = 0; i < int(Vector::length()); ++i) out.push_back(number(double(v[i])));
    return tinygltf::Value(std::move(out));
}

int wrapMode(Wrap wrap) {
    return wrap == Wrap::ClampToEdge      ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
           : wrap == Wrap::MirroredRepeat ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                          : TINYGLTF_TEXTURE_WRAP_REPEAT;
}

}  // namespace

void GltfWriter::extend(tinygltf::ExtensionMap& extensions, const char* name, tinygltf::Value::Object members) {
    extensions[name] = tinygltf::Value(std::move(members));
    auto& used = model_.extensionsUsed;
    if (std::ranges::count(used, name) == 0) used.emplace_back(name);
}

void GltfWriter::addTexture(const Texture& texture) {
    const std::vector<uint8_t> png = encodePng({texture.width, texture.height, texture.rgba});
    tinygltf::Image image;
    image.name = texture.name;
    image.mimeType = "image/png";
    image.bufferView = addView(png.data(), png.size(), 0);
    model_.images.push_back(std::move(image));
    tinygltf::Sampler sampler;
    sampler.magFilter = sampler.minFilter =
        texture.filter == TexelFilter::Nearest ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = wrapMode(texture.wrapU);
    sampler.wrapT = wrapMode(texture.wrapV);
    model_.samplers.push_back(std::move(sampler));
    tinygltf::Texture out;
    out.name = texture.name;
    out.source = int(model_.images.size() - 1);
    out.sampler = int(model_.samplers.size() - 1);
    model_.textures.push_back(std::move(out));
}

template <typename Info>
Info GltfWriter::textureInfo(const TextureRef& ref) {
    Info info;
    info.index = ref.texture;
    info.texCoord = int(ref.texCoord);
    const glm::vec3& u = ref.transform[0];
    const glm::vec3& v = ref.transform[1];
    if (ref.texture < 0 || (u == glm::vec3(1, 0, 0) && v == glm::vec3(0, 1, 0))) return info;

    // Decompose the matrix: its columns are the scale times (cos, -sin) and (sin, cos).
    const double scaleU = std::hypot(u.x, v.x);
    const double angle = scaleU > 0 ? std::atan2(-v.x, u.x) : std::atan2(u.y, v.y);
    const double scaleV = std::sin(angle) * u.y + std::cos(angle) * v.y;
    extend(info.extensions, "KHR_texture_transform",
           {{"offset", array(glm::dvec2(u.z, v.z))},
            {"scale", array(glm::dvec2(scaleU, scaleV))},
            {"rotation", number(angle)}});
    return info;
}

void GltfWriter::addMaterials(const Scene& scene) {
    for (const Texture& texture : scene.textures) addTexture(texture);
    for (const Material& m : scene.materials) {
        tinygltf::Material out;
        out.name = m.name;
        out.pbrMetallicRoughness.baseColorFactor = numbers(m.baseColor);
        out.pbrMetallicRoughness.metallicFactor = double(m.metallic);
        out.pbrMetallicRoughness.roughnessFactor = double(m.roughness);
        out.pbrMetallicRoughness.baseColorTexture = textureInfo<tinygltf::TextureInfo>(m.baseColorTexture);
        out.pbrMetallicRoughness.metallicRoughnessTexture =
            textureInfo<tinygltf::TextureInfo>(m.metallicRoughnessTexture);
        out.normalTexture = textureInfo<tinygltf::NormalTextureInfo>(m.normalTexture);
        out.normalTexture.scale = double(m.normalScale);
        out.emissiveTexture = textureInfo<tinygltf::TextureInfo>(m.emissiveTexture);
        out.doubleSided = m.doubleSided;
        if (m.alphaMode == AlphaMode::Mask) out.alphaCutoff = double(m.alphaCutoff);
        out.alphaMode = m.alphaMode == AlphaMode::Mask ? "MASK" : m.alphaMode == AlphaMode::Blend ? "BLEND" : "OPAQUE";

        // emissiveFactor is at most 1; the strength has the rest.
        const double strength = std::max({1.0, double(m.emission.x), double(m.emission.y), double(m.emission.z)});
        out.emissiveFactor = numbers(glm::dvec3(m.emission) / strength);
        if (strength > 1)
            extend(out.extensions, "KHR_materials_emissive_strength", {{"emissiveStrength", number(strength)}});
        if (m.specular != 1 || m.specularColor != glm::vec3(1))
            extend(out.extensions, "KHR_materials_specular",
                   {{"specularFactor", number(m.specular)}, {"specularColorFactor", array(m.specularColor)}});
        if (m.transmission > 0)
            extend(out.extensions, "KHR_materials_transmission", {{"transmissionFactor", number(m.transmission)}});
        if (m.ior != 1.5f) extend(out.extensions, "KHR_materials_ior", {{"ior", number(m.ior)}});
        model_.materials.push_back(std::move(out));
    }
}

}  // namespace voxray

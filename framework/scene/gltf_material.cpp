#include "scene/gltf_material.h"

#include <algorithm>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "scene/gltf_values.h"
#include "scene/panes.h"

namespace voxray {
namespace {

constexpr const char* emissiveStrength = "KHR_materials_emissive_strength";
constexpr const char* transmission = "KHR_materials_transmission";
constexpr const char* specular = "KHR_materials_specular";
constexpr const char* textureTransform = "KHR_texture_transform";

}  // namespace

Wrap MaterialReader::wrap(int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::Repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::ClampToEdge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::MirroredRepeat;
        default:
            file_.fail("texture wrap mode {} is not one of glTF's", mode);
    }
}

TexelFilter MaterialReader::filter(const tinygltf::Sampler& sampler) {
    // The magnification filter counts, for lookups in level 0; if it is unspecified (-1), the other filter.
    switch (sampler.magFilter == -1 ? sampler.minFilter : sampler.magFilter) {
        case -1:
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
            return TexelFilter::Linear;
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            return TexelFilter::Nearest;
        default:
            file_.fail("texture filters {} and {}: one is not of glTF's", sampler.magFilter, sampler.minFilter);
    }
}

TextureRef MaterialReader::texture(int index, int texCoord, const tinygltf::ExtensionMap& extensions, bool srgb,
                                   const std::string& what) {
    TextureRef ref;
    if (index < 0) return ref;
    const tinygltf::Model& model = file_.model();
    const tinygltf::Texture& source = file_.at(model.textures, index, "texture");
    if (source.source < 0) {
        file_.warn("{}: texture {} has no image in a supported format; left out", what, index);
        return ref;
    }
    const EncodedImage& image = file_.at(file_.images(), source.source, "image");
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    TexelFilter texelFilter = TexelFilter::Linear;
    if (source.sampler >= 0) {
        const tinygltf::Sampler& sampler = file_.at(model.samplers, source.sampler, "sampler");
        wrapU = wrap(sampler.wrapS);
        wrapV = wrap(sampler.wrapT);
        texelFilter = filter(sampler);
    }

    // One texture per image, encoding and sampler.
    const auto [entry, added] =
        textures_.try_emplace({source.source, srgb, wrapU, wrapV, texelFilter}, int32_t(scene_.textures.size()));
    if (added) {
        scene_.textures.push_back(
            {.name = shortLine(image.name), .srgb = srgb, .wrapU = wrapU, .wrapV = wrapV, .filter = texelFilter});
        images_.push_back(source.source);
    }
    ref.texture = entry->second;

    // uv' = offset + rotation * scale * uv; the rotation is counter-clockwise with v growing downwards.
    glm::vec2 offset(0);
    glm::vec2 scale(1);
    float rotation = 0;
    float set = float(texCoord);
    readExtensionVector(file_, what, extensions, textureTransform, "offset", -maxNumber, maxNumber, offset);
    readExtensionVector(file_, what, extensions, textureTransform, "scale", -maxNumber, maxNumber, scale);
    readExtension(file_, what, extensions, textureTransform, "rotation", -maxNumber, maxNumber, rotation);
    readExtension(file_, what, extensions, textureTransform, "texCoord", 0, 1e6, set);
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    ref.transform = {glm::vec3(c * scale.x, s * scale.y, offset.x), glm::vec3(-s * scale.x, c * scale.y, offset.y)};
    if (set == 0 || set == 1)
        ref.texCoord = uint32_t(set);
    else
        file_.warn("{}: TEXCOORD_{} is not supported; TEXCOORD_0 is used", what, set);
    return ref;
}

float MaterialReader::readIor(const tinygltf::Material& source, const std::string& what) {
    constexpr const char* extension = "KHR_materials_ior";
    float ior = 1.5f;
    readExtension(file_, what, source.extensions, extension, "ior", 0, 1000, ior);
    // 0 means infinite (KHR_materials_ior); values between 0 and 1 are invalid.
    return ior == 0 ? 0 : clampedFloat(file_, ior, 1, 1000, what + ": KHR_materials_ior.ior");
}

Material MaterialReader::read(int index) {
    Material m;
    if (index < 0) {
        m.name = "default";
        return m;
    }
    const tinygltf::Material& source = file_.at(file_.model().materials, index, "material");
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    m.name = source.name.empty() ? fmt::format("material_{}", index) : shortLine(source.name);
    const std::string what = fmt::format("material {} '{}'", index, m.name);

    // Factors.
    readVector(file_, pbr.baseColorFactor, m.baseColor, 0, 1, what + ": baseColorFactor", clampedFloat);
    m.metallic = clampedFloat(file_, pbr.metallicFactor, 0, 1, what + ": metallicFactor");
    m.roughness = clampedFloat(file_, pbr.roughnessFactor, 0, 1, what + ": roughnessFactor");
    readExtension(file_, what, source.extensions, specular, "specularFactor", 0, 1, m.specular);
    readExtensionVector(file_, what, source.extensions, specular, "specularColorFactor", 0, maxNumber, m.specularColor);
    readExtension(file_, what, source.extensions, transmission, "transmissionFactor", 0, 1, m.transmission);
    m.ior = readIor(source, what);
    float strength = 1;
    readExtension(file_, what, source.extensions, emissiveStrength, "emissiveStrength", 0, maxNumber, strength);
    readVector(file_, source.emissiveFactor, m.emission, 0, maxNumber, what + ": emissiveFactor", clampedFloat);
    for (int i = 0; i < 3; ++i)
        m.emission[i] = clampedFloat(file_, double(m.emission[i]) * strength, 0, maxNumber, what + ": emission");
    m.doubleSided = source.doubleSided;

    // Alpha.
    m.alphaCutoff = clampedFloat(file_, source.alphaCutoff, 0, maxNumber, what + ": alphaCutoff");
    if (source.alphaMode == "MASK")
        m.alphaMode = AlphaMode::Mask;
    else if (source.alphaMode == "BLEND")
        m.alphaMode = AlphaMode::Blend;
    else if (source.alphaMode != "OPAQUE")
        file_.fail("{}: alphaMode '{}' is not one of glTF's", what, source.alphaMode);
    if (m.alphaMode == AlphaMode::Blend && !isPane(m))
        file_.warn("{}: alphaMode BLEND is rendered as opaque; 'scene.hide' takes it out", what);

    // Textures.
    const tinygltf::TextureInfo& color = pbr.baseColorTexture;
    const tinygltf::TextureInfo& rough = pbr.metallicRoughnessTexture;
    const tinygltf::NormalTextureInfo& normal = source.normalTexture;
    const tinygltf::TextureInfo& emissive = source.emissiveTexture;
    m.baseColorTexture = texture(color.index, color.texCoord, color.extensions, true, what);
    m.metallicRoughnessTexture = texture(rough.index, rough.texCoord, rough.extensions, false, what);
    m.normalTexture = texture(normal.index, normal.texCoord, normal.extensions, false, what);
    m.emissiveTexture = texture(emissive.index, emissive.texCoord, emissive.extensions, true, what);
    m.normalScale = clampedFloat(file_, normal.scale, -maxNumber, maxNumber, what + ": normalTexture.scale");

    // Unsupported properties.
    if (isPane(m))
        file_.warn(
            "{}: {} makes it a pane: light passes it straight, times its colour, and nothing is reflected or bent; "
            "'materials: lambert' makes it opaque",
            what, transmission);
    else if (m.transmission > 0)
        file_.warn("{}: {} is rendered as opaque: it emits, or transmits less than half", what, transmission);
    if (source.extensions.contains("KHR_materials_unlit"))
        file_.warn("{}: KHR_materials_unlit is rendered as an ordinary, lit material", what);
    if (extensionMember(source.extensions, transmission, "transmissionTexture") != nullptr)
        file_.warn("{}: transmissionTexture of {} is left out; its factor is used", what, transmission);
    for (const char* member : {"specularTexture", "specularColorTexture"})
        if (extensionMember(source.extensions, specular, member) != nullptr)
            file_.warn("{}: {} of {} is left out; its factor is used", what, member, specular);
    return m;
}

uint32_t MaterialReader::material(int index) {
    const auto [entry, added] = materials_.try_emplace(std::max(index, -1), uint32_t(scene_.materials.size()));
    if (added) scene_.materials.push_back(read(index));
    return entry->second;
}

void MaterialReader::decodeTextures() {
    // Decode each image once, in parallel; report the first error in the file's order.
    std::vector<int> images = images_;
    std::sort(images.begin(), images.end());
    images.erase(std::unique(images.begin(), images.end()), images.end());
    std::vector<DecodedImage> decoded(images.size());
    std::vector<std::string> errors(images.size());
    parallelRanges(images.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !interruptRequested(); ++i) {
            const EncodedImage& image = file_.images()[size_t(images[i])];
            const std::string name =
                shortLine(fmt::format("image {} '{}'", images[i], image.name.empty() ? image.uri : image.name));
            try {
                if (!image.fault.empty()) throw Error("{}: {}", name, image.fault);
                decoded[i] = decodeImage(image.bytes, name.c_str());
            } catch (const Error& error) {
                errors[i] = error.what();
            }
        }
    });
    if (interruptRequested()) throw Interrupted();
    for (const std::string& error : errors)
        if (!error.empty()) file_.fail("{}", error);

    // Copy them into the textures.
    for (size_t i = 0; i < images_.size(); ++i) {
        const auto found = std::lower_bound(images.begin(), images.end(), images_[i]);
        const DecodedImage& image = decoded[size_t(found - images.begin())];
        scene_.textures[i].width = image.width;
        scene_.textures[i].height = image.height;
        scene_.textures[i].rgba = image.rgba;
    }
}

}  // namespace voxray

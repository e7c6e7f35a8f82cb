#include "trace/gpu_alpha_mask.h"

#include <map>
#include <span>

#include "base/error.h"
#include "shaders/trace/trace_types.h"
#include "trace/texture_lookup.h"

namespace voxray {
namespace {

/// Concatenated alpha channels of textures, each texture once.
class AlphaTexels {
 public:
    explicit AlphaTexels(const Scene& scene) : scene_(scene) {}

    gpu::AlphaMaterial describe(const Material& material) {
        const int32_t index = material.baseColorTexture.texture;
        if (index < 0) return {alphaThreshold(material), NO_ALPHA_TEXTURE, 0, 0, 0, 0, 0};
        const Texture& texture = scene_.textures[size_t(index)];
        const auto [entry, isNew] = firstTexels_.try_emplace(index, uint32_t(texels_.size()));
        if (isNew) append(texture);
        return {alphaThreshold(material), entry->second,           texture.width,           texture.height,
                uint32_t(texture.wrapU),  uint32_t(texture.wrapV), uint32_t(texture.filter)};
    }

    /// All texels, padded to words.
    std::vector<uint8_t> padded() const {
        std::vector<uint8_t> bytes = texels_;
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return bytes;
    }

 private:
    void append(const Texture& texture) {
        const uint64_t count = uint64_t(texture.width) * texture.height;
        if (texels_.size() + count >= NO_ALPHA_TEXTURE)
            throw Error("texture '{}': alpha masks of more than 2^32 texels can't be traced on the GPU", texture.name);
        for (uint64_t i = 0; i < count; ++i) texels_.push_back(texture.rgba[4 * i + 3]);
    }

    const Scene& scene_;
    std::map<int32_t, uint32_t> firstTexels_;
    std::vector<uint8_t> texels_;
};

template <typename T>
Buffer uploadedUnlessEmpty(Device& device, CommandStream& stream, const char* name, const std::vector<T>& data) {
    if (data.empty()) return {};
    Buffer buffer(device, name, data.size() * sizeof(T));
    stream.upload(buffer, data);
    return buffer;
}

}  // namespace

GpuAlphaMask makeGpuAlphaMask(Device& device, CommandStream& stream, const SceneState& state,
                              const TracingOrder& order) {
    // Masked materials and their textures.
    AlphaTexels texels(*state.scene);
    std::vector<gpu::AlphaMaterial> materials;
    std::map<uint32_t, uint32_t> materialNumbers;
    std::vector<gpu::MaskedTriangle> triangles;
    for (uint32_t t : std::span(order.triangles).subspan(order.opaqueCount)) {
        const uint32_t index = state.geometry.triangleMaterials[t];
        const Material& material = state.scene->materials[index];
        const auto [number, isNew] = materialNumbers.try_emplace(index, uint32_t(materials.size()));
        if (isNew) materials.push_back(texels.describe(material));

        // Texture coordinates and alpha at the vertices.
        gpu::MaskedTriangle triangle{};
        triangle.material = number->second;
        for (int corner = 0; corner < 3; ++corner) {
            const VertexAttributes& vertex = state.geometry.attributes[state.geometry.triangles[t][corner]];
            triangle.uv[corner] = textureCoordinates(material.baseColorTexture, vertex.texCoords);
            triangle.alpha[corner] = material.baseColor.a * vertex.color.a;
        }
        triangles.push_back(triangle);
    }
    GpuAlphaMask mask;
    mask.triangles = uploadedUnlessEmpty(device, stream, "alpha-masked triangles", triangles);
    mask.materials = uploadedUnlessEmpty(device, stream, "alpha-masked materials", materials);
    mask.texels = uploadedUnlessEmpty(device, stream, "alpha masks", texels.padded());
    return mask;
}

}  // namespace voxray

#include "trace/texture_lookup.h"

#include <array>

#include "base/srgb.h"

namespace voxray {

namespace {

/// Linear values of the 256 sRGB codes.
const std::array<float, 256> kSrgbToLinear = [] {
    std::array<float, 256> table{};
    for (size_t code = 0; code < 256; ++code) table[code] = float(srgbDecode(double(code) / 255.0));
    return table;
}();

const uint8_t* codeOf(const Texture& texture, int32_t x, int32_t y) {
    return &texture.rgba[(size_t(y) * texture.width + size_t(x)) * 4];
}

constexpr float kCodeScale = 1.0f / 255.0f;

glm::vec4 texel(const Texture& texture, int32_t x, int32_t y) {
    const uint8_t* code = codeOf(texture, x, y);
    if (texture.srgb)
        return {kSrgbToLinear[code[0]], kSrgbToLinear[code[1]], kSrgbToLinear[code[2]], code[3] * kCodeScale};
    return glm::vec4(code[0], code[1], code[2], code[3]) * kCodeScale;
}

/// Wraps a coordinate to a range in which `floor(x * size)` fits an integer, without loss of precision.
float reduceCoordinate(float x, Wrap wrap) {
    if (!std::isfinite(x)) return 0.0f;
    switch (wrap) {
        case Wrap::Repeat:
            return x - std::floor(x);
        case Wrap::MirroredRepeat:
            return x - 2.0f * std::floor(0.5f * x);
        case Wrap::ClampToEdge:
            break;
    }
    return std::fmin(std::fmax(x, 0.0f), 1.0f);
}

}  // namespace

int32_t wrapTexel(int32_t x, int32_t size, Wrap wrap) {
    switch (wrap) {
        case Wrap::Repeat: {
            const int32_t r = x % size;
            return r < 0 ? r + size : r;
        }
        case Wrap::MirroredRepeat: {
            int32_t r = x % (2 * size);
            if (r < 0) r += 2 * size;
            return r < size ? r : 2 * size - 1 - r;
        }
        case Wrap::ClampToEdge:
            break;
    }
    return x < 0 ? 0 : (x >= size ? size - 1 : x);
}

namespace {

/// Linear filter along one axis: two texels and the weight of the second one.
struct Texels {
    int32_t first, second;
    float weight;
};

Texels filteredTexels(float coordinate, int32_t size, Wrap wrap, TexelFilter filter) {
    const bool isNearest = filter == TexelFilter::Nearest;
    const float x = reduceCoordinate(coordinate, wrap) * float(size) - (isNearest ? 0.0f : 0.5f);
    const float floorX = std::floor(x);
    const int32_t first = int32_t(floorX), second = first + 1;
    const float weight = isNearest ? 0.0f : x - floorX;
    // Most texels need no division
    if (first >= 0 && second < size) return {first, second, weight};
    return {wrapTexel(first, size, wrap), wrapTexel(second, size, wrap), weight};
}

}  // namespace

namespace {

/// Filters what `texelAt` finds in a texture, a function of the texture and of a texel's coordinates.
template <typename TexelAt>
auto filtered(const Texture& texture, glm::vec2 uv, const TexelAt& texelAt) {
    const Texels x = filteredTexels(uv.x, int32_t(texture.width), texture.wrapU, texture.filter);
    const Texels y = filteredTexels(uv.y, int32_t(texture.height), texture.wrapV, texture.filter);
    const auto row = [&](int32_t rowY) {
        return texelAt(texture, x.first, rowY) * (1.0f - x.weight) + texelAt(texture, x.second, rowY) * x.weight;
    };
    return row(y.first) * (1.0f - y.weight) + row(y.second) * y.weight;
}

float texelAlpha(const Texture& texture, int32_t x, int32_t y) {
    return codeOf(texture, x, y)[3] * kCodeScale;
}

}  // namespace

glm::vec4 sampleTexture(const Texture& texture, glm::vec2 uv) {
    return filtered(texture, uv, texel);
}

void prefetchTexels(const Texture& texture, glm::vec2 uv) {
    const int32_t width = int32_t(texture.width), height = int32_t(texture.height);
    const int32_t x = filteredTexels(uv.x, width, texture.wrapU, texture.filter).first;
    const Texels y = filteredTexels(uv.y, height, texture.wrapV, texture.filter);
    __builtin_prefetch(codeOf(texture, x, y.first));
    __builtin_prefetch(codeOf(texture, x, y.second));
}

namespace {

glm::vec2 textureCoordinates(const SceneState& state, const TextureRef& ref, uint32_t triangle, float u, float v) {
    const Geometry& g = state.geometry;
    const glm::uvec3 corners = g.triangles[triangle];
    return textureCoordinates(ref, interpolate(g.attributes[corners.x].texCoords, g.attributes[corners.y].texCoords,
                                               g.attributes[corners.z].texCoords, u, v));
}

}  // namespace

glm::vec4 sampleTexture(const SceneState& state, const TextureRef& ref, uint32_t triangle, float u, float v) {
    return sampleTexture(state.scene->textures[size_t(ref.texture)], textureCoordinates(state, ref, triangle, u, v));
}

float alphaThreshold(const Material& material) {
    return material.alphaCutoff * (1.0f - 0x1p-20f);
}

bool isCutAway(const SceneState& state, uint32_t triangle, float u, float v) {
    const Geometry& geometry = state.geometry;
    const Material& material = state.scene->materials[geometry.triangleMaterials[triangle]];
    const glm::uvec3 corners = geometry.triangles[triangle];
    float alpha = material.baseColor.a * interpolate(geometry.attributes[corners.x].color.a,
                                                     geometry.attributes[corners.y].color.a,
                                                     geometry.attributes[corners.z].color.a, u, v);
    if (const TextureRef& ref = material.baseColorTexture; ref.texture >= 0)
        alpha *= filtered(state.scene->textures[size_t(ref.texture)], textureCoordinates(state, ref, triangle, u, v),
                          texelAlpha);
    return alpha < alphaThreshold(material);
}

}  // namespace voxray

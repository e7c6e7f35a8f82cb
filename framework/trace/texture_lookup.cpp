#include "trace/texture_lookup.h"

namespace voxray {

namespace {

std::array<float, 256> makeSrgbTable() {
    std::array<float, 256> table{};
    for (int code = 0; code < 256; ++code) {
        const double s = code / 255.0;
        table[size_t(code)] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return table;
}

glm::vec4 texel(const Texture& texture, int32_t x, int32_t y) {
    const uint8_t* code = &texture.rgba[(size_t(y) * texture.width + size_t(x)) * 4];
    constexpr float kScale = 1.0f / 255.0f;
    if (texture.srgb)
        return {kSrgbToLinear[code[0]], kSrgbToLinear[code[1]], kSrgbToLinear[code[2]], code[3] * kScale};
    return glm::vec4(code[0], code[1], code[2], code[3]) * kScale;
}

/// Moves a coordinate into a range in which `floor(x * size)` fits an integer and no precision is lost.
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

const std::array<float, 256> kSrgbToLinear = makeSrgbTable();

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

glm::vec4 sampleTexture(const Texture& texture, glm::vec2 uv) {
    const int32_t width = int32_t(texture.width), height = int32_t(texture.height);
    const float x = reduceCoordinate(uv.x, texture.wrapU) * float(width) - 0.5f;
    const float y = reduceCoordinate(uv.y, texture.wrapV) * float(height) - 0.5f;
    const float floorX = std::floor(x), floorY = std::floor(y);
    const float fx = x - floorX, fy = y - floorY;
    const int32_t x0 = wrapTexel(int32_t(floorX), width, texture.wrapU);
    const int32_t x1 = wrapTexel(int32_t(floorX) + 1, width, texture.wrapU);
    const int32_t y0 = wrapTexel(int32_t(floorY), height, texture.wrapV);
    const int32_t y1 = wrapTexel(int32_t(floorY) + 1, height, texture.wrapV);
    const glm::vec4 top = texel(texture, x0, y0) * (1.0f - fx) + texel(texture, x1, y0) * fx;
    const glm::vec4 bottom = texel(texture, x0, y1) * (1.0f - fx) + texel(texture, x1, y1) * fx;
    return top * (1.0f - fy) + bottom * fy;
}

bool isCutAway(const SceneState& state, uint32_t triangle, float u, float v) {
    const Geometry& geometry = state.geometry;
    const Material& material = state.scene->materials[geometry.triangleMaterials[triangle]];
    const glm::uvec3 corners = geometry.triangles[triangle];
    const VertexAttributes& a = geometry.attributes[corners.x];
    const VertexAttributes& b = geometry.attributes[corners.y];
    const VertexAttributes& c = geometry.attributes[corners.z];
    float alpha = material.baseColor.a * interpolate(a.color.a, b.color.a, c.color.a, u, v);
    if (material.baseColorTexture.texture >= 0) {
        const glm::vec4 texCoords = interpolate(a.texCoords, b.texCoords, c.texCoords, u, v);
        alpha *= sampleTexture(state.scene->textures[size_t(material.baseColorTexture.texture)],
                               textureCoordinates(material.baseColorTexture, texCoords))
                     .a;
    }
    return alpha < material.alphaCutoff;
}

}  // namespace voxray

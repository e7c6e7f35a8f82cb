#include "passes/path_trace/surfaces.h"

#include <cmath>
#include <glm/common.hpp>

#include "base/parallel.h"
#include "trace/texture_lookup.h"

namespace voxray::path_trace {

namespace {

constexpr float kMinCosine = 1e-3f;

bool readsTextures(const Material& m) {
    return m.baseColorTexture.texture >= 0 || m.metallicRoughnessTexture.texture >= 0 || m.normalTexture.texture >= 0;
}

/// World-space normal of a normal map; the interpolated one where map or tangent are degenerate.
glm::vec3 mapNormal(const glm::vec3& normal, const glm::vec4& tangent, const glm::vec4& texel, float scale) {
    const glm::vec3 t(tangent), b = glm::cross(normal, t) * tangent.w;
    const glm::vec3 mapped = t * ((2.0f * texel.x - 1.0f) * scale) + b * ((2.0f * texel.y - 1.0f) * scale) +
                             normal * (2.0f * texel.z - 1.0f);
    const float length2 = glm::dot(mapped, mapped);
    return length2 > 1e-12f && std::isfinite(length2) ? mapped / std::sqrt(length2) : normal;
}

}  // namespace

SurfaceTable::SurfaceTable(const SceneState& state, ExpectedRays rays) : state_(&state) {
    for (const Material& m : state.scene->materials)
        materials_.push_back(
            {Bsdf::make(glm::vec3(m.baseColor), m.metallic, m.roughness, m.specular, m.specularColor, m.ior), &m,
             m.emissiveTexture.texture >= 0 || m.alphaMode == AlphaMode::Mask});
    if (rays == ExpectedRays::Few) return;

    std::vector<SurfaceTriangle> triangles(triangleCount());
    parallelRanges(triangles.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) triangles[i] = makeTriangle(uint32_t(i));
    });
    triangles_ = std::move(triangles);
}

void SurfaceTable::updateMoving() {
    if (triangles_.empty()) return;
    for (const InstanceRange& range : movingInstanceRanges(state_->geometry))
        parallelRanges(range.triangleCount, 4096, [&](size_t begin, size_t end) {
            for (size_t i = range.firstTriangle + begin; i < range.firstTriangle + end; ++i)
                triangles_[i] = makeTriangle(uint32_t(i));
        });
}

SurfaceTriangle SurfaceTable::makeTriangle(uint32_t i) const {
    const Geometry& geometry = state_->geometry;
    const glm::uvec3 corners = geometry.triangles[i];
    const glm::vec3 a = geometry.positions[corners.x];
    const glm::vec3 b = geometry.positions[corners.y];
    const glm::vec3 c = geometry.positions[corners.z];
    SurfaceTriangle t;
    t.corner = a;
    t.edge1 = b - a;
    t.edge2 = c - a;
    t.material = geometry.triangleMaterials[i];
    if (const auto light = lights_.find(i); light != lights_.end()) t.light = light->second;

    // In double: slivers underflow a float
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double length = glm::length(n);
    if (length > 0.0) t.normal = glm::vec3(n / length);
    t.offset = planeOffset(a, b, c, t.normal);

    // Most triangles need only their material's constants
    bool isSimple = !readsTextures(*materials_[t.material].source);
    for (const uint32_t corner : {corners.x, corners.y, corners.z}) {
        const VertexAttributes& vertex = geometry.attributes[corner];
        isSimple = isSimple && glm::vec3(vertex.color) == glm::vec3(1.0f) &&
                   std::fabs(glm::dot(vertex.normal, t.normal)) > 1.0f - 1e-6f;
    }
    t.isSimple = isSimple ? 1 : 0;
    return t;
}

void SurfaceTable::setLight(uint32_t triangle, uint32_t light) {
    if (triangles_.empty())
        lights_[triangle] = light;
    else
        triangles_[triangle].light = light;
}

SurfacePoint SurfaceTable::pointAt(const Hit& hit, const glm::vec3& direction) const {
    const SurfaceTriangle t = triangle(hit.triangle);
    SurfacePoint point;
    point.position = t.corner + t.edge1 * hit.u + t.edge2 * hit.v;
    point.offset = t.offsetAt(point.position);
    point.faceNormal = glm::dot(t.normal, direction) > 0.0f ? -t.normal : t.normal;
    point.shadingNormal = point.faceNormal;
    point.bsdf = materials_[t.material].bsdf;
    if (!t.isSimple) applyTextures(hit, point);

    // A shading normal that faces away from the ray has no specular lobe: tilt it back
    if (point.bsdf.hasSpecular()) {
        const float cosOut = -glm::dot(point.shadingNormal, direction);
        if (cosOut < kMinCosine)
            point.shadingNormal = glm::normalize(point.shadingNormal - direction * (kMinCosine - cosOut));
    }
    return point;
}

void SurfaceTable::prefetch(std::span<const Hit> hits) const {
    if (triangles_.empty()) return;
    const Geometry& geometry = state_->geometry;
    const auto forEach = [&](const auto& step) {
        for (const Hit& hit : hits)
            if (hit.triangle != Hit::kMiss) step(hit);
    };
    // Each step reads what the one before asked for
    forEach([&](const Hit& hit) {
        __builtin_prefetch(&triangles_[hit.triangle]);
        __builtin_prefetch(&geometry.triangles[hit.triangle]);
        __builtin_prefetch(&geometry.triangleMaterials[hit.triangle]);
    });
    forEach([&](const Hit& hit) {
        if (triangles_[hit.triangle].isSimple) return;
        const glm::uvec3 corners = geometry.triangles[hit.triangle];
        for (const uint32_t corner : {corners.x, corners.y, corners.z}) {
            __builtin_prefetch(&geometry.attributes[corner].normal);
            __builtin_prefetch(&geometry.attributes[corner].color);
        }
    });
    forEach([&](const Hit& hit) {
        const SurfaceTriangle& t = triangles_[hit.triangle];
        const Material& m = *materials_[t.material].source;
        if (t.isSimple || !readsTextures(m)) return;
        const glm::vec4 texCoords = texCoordsAt(hit);
        for (const TextureRef* ref : {&m.normalTexture, &m.baseColorTexture, &m.metallicRoughnessTexture})
            if (ref->texture >= 0)
                prefetchTexels(state_->scene->textures[size_t(ref->texture)], textureCoordinates(*ref, texCoords));
    });
}

glm::vec4 SurfaceTable::texCoordsAt(const Hit& hit) const {
    const Geometry& geometry = state_->geometry;
    const glm::uvec3 corners = geometry.triangles[hit.triangle];
    return interpolate(geometry.attributes[corners.x].texCoords, geometry.attributes[corners.y].texCoords,
                       geometry.attributes[corners.z].texCoords, hit.u, hit.v);
}

void SurfaceTable::applyTextures(const Hit& hit, SurfacePoint& point) const {
    const Geometry& geometry = state_->geometry;
    const glm::uvec3 corners = geometry.triangles[hit.triangle];
    const VertexAttributes& a = geometry.attributes[corners.x];
    const VertexAttributes& b = geometry.attributes[corners.y];
    const VertexAttributes& c = geometry.attributes[corners.z];
    const Material& m = *materials_[geometry.triangleMaterials[hit.triangle]].source;
    const glm::vec4 texCoords = texCoordsAt(hit);

    // Normal: interpolated, mapped, flipped to the ray's side
    glm::vec3 normal = interpolate(a.normal, b.normal, c.normal, hit.u, hit.v);
    const float length2 = glm::dot(normal, normal);
    normal = length2 > 1e-12f ? normal / std::sqrt(length2) : point.faceNormal;
    const float sign = glm::dot(normal, point.faceNormal) < 0.0f ? -1.0f : 1.0f;
    if (m.normalTexture.texture >= 0)
        normal = mapNormal(normal, interpolate(a.tangent, b.tangent, c.tangent, hit.u, hit.v),
                           lookUp(m.normalTexture, texCoords), m.normalScale);
    point.shadingNormal = normal * sign;

    // BSDF: factors times textures times vertex color
    glm::vec3 baseColor = glm::vec3(m.baseColor) * glm::vec3(interpolate(a.color, b.color, c.color, hit.u, hit.v));
    if (m.baseColorTexture.texture >= 0) baseColor *= glm::vec3(lookUp(m.baseColorTexture, texCoords));
    float metallic = m.metallic, roughness = m.roughness;
    if (m.metallicRoughnessTexture.texture >= 0) {
        const glm::vec4 texel = lookUp(m.metallicRoughnessTexture, texCoords);
        roughness *= texel.g;
        metallic *= texel.b;
    }
    point.bsdf = Bsdf::make(baseColor, metallic, roughness, m.specular, m.specularColor, m.ior);
}

glm::vec3 SurfaceTable::texturedEmission(uint32_t triangle, float u, float v) const {
    const Geometry& geometry = state_->geometry;
    const glm::uvec3 corners = geometry.triangles[triangle];
    const Material& m = *materials_[geometry.triangleMaterials[triangle]].source;
    if (m.alphaMode == AlphaMode::Mask && isCutAway(*state_, triangle, u, v)) return glm::vec3(0.0f);
    if (m.emissiveTexture.texture < 0) return m.emission;
    const glm::vec4 texCoords =
        interpolate(geometry.attributes[corners.x].texCoords, geometry.attributes[corners.y].texCoords,
                    geometry.attributes[corners.z].texCoords, u, v);
    return m.emission * glm::vec3(lookUp(m.emissiveTexture, texCoords));
}

glm::vec4 SurfaceTable::lookUp(const TextureRef& ref, const glm::vec4& texCoords) const {
    return sampleTexture(state_->scene->textures[size_t(ref.texture)], textureCoordinates(ref, texCoords));
}

}  // namespace voxray::path_trace

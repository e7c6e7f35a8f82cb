#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "passes/path_trace/bsdf.h"
#include "scene/geometry.h"
#include "scene/surface_offset.h"
#include "trace/embree_scene.h"
#include "trace/ray.h"

namespace voxray::path_trace {

constexpr uint32_t kNoLight = 0xffffffffu;

/// Shading data of a triangle, in one cache line.
struct alignas(64) SurfaceTriangle {
    glm::vec3 corner{0.0f};
    float offset = 0.0f;  ///< Of its plane: planeOffset().
    glm::vec3 edge1{0.0f};
    uint32_t material = 0;
    glm::vec3 edge2{0.0f};
    uint32_t light = kNoLight;     ///< Index of its LightTable patch, or kNoLight.
    glm::vec3 normal{0.0f, 1, 0};  ///< Geometric, unit length, on the front side.
    uint32_t isSimple = 0;         ///< 1: flat, no textures, no vertex colors.

    /// Offset of ray origins at a point of it, m.
    float offsetAt(const glm::vec3& position) const { return std::max(offset, pointOffset(position)); }
};

/// A path vertex on a surface.
struct SurfacePoint {
    glm::vec3 position{0.0f};
    float offset = 0.0f;
    glm::vec3 faceNormal{0.0f};     ///< Geometric normal on the side of the incoming ray.
    glm::vec3 shadingNormal{0.0f};  ///< On the same side.
    Bsdf bsdf;

    /// Origin of a ray that leaves on the incoming ray's side.
    glm::vec3 rayOrigin() const { return position + faceNormal * offset; }
};

/// Shading data of all triangles and materials. Thread-safe after construction.
class SurfaceTable {
 public:
    /// @param state must outlive this object. @param rays Few: triangles are computed at each hit, not in
    /// advance.
    explicit SurfaceTable(const SceneState& state, ExpectedRays rays = ExpectedRays::Many);

    SurfaceTriangle triangle(uint32_t i) const { return triangles_.empty() ? makeTriangle(i) : triangles_[i]; }
    size_t triangleCount() const { return state_->geometry.triangles.size(); }
    /// Takes over triangles that have moved, which then are of no patch of a LightTable. Not thread-safe.
    void updateMoving();
    /// Assigns a triangle to a patch of LightTable. Not thread-safe.
    void setLight(uint32_t triangle, uint32_t light);

    /// Asks for the memory that pointAt() will read at these hits, those that miss left out: what it waits for at one,
    /// it then doesn't at the next.
    void prefetch(std::span<const Hit> hits) const;
    /// Geometry and material at a hit. @param direction of the ray, unit length.
    SurfacePoint pointAt(const Hit& hit, const glm::vec3& direction) const;

    /// Emitted radiance at barycentrics (u, v); 0 where the alpha mask cuts the surface away.
    glm::vec3 emission(uint32_t triangle, float u, float v) const {
        const MaterialData& m = materials_[state_->geometry.triangleMaterials[triangle]];
        return m.emissionVaries ? texturedEmission(triangle, u, v) : m.source->emission;
    }
    /// Whether emission varies over the triangle.
    bool emissionVaries(const SurfaceTriangle& triangle) const { return materials_[triangle.material].emissionVaries; }
    /// Whether it emits towards a unit `direction` that points away from it.
    bool emitsTowards(const SurfaceTriangle& triangle, const glm::vec3& direction) const {
        return materials_[triangle.material].source->doubleSided || glm::dot(triangle.normal, direction) > 0.0f;
    }
    const Material& material(const SurfaceTriangle& triangle) const { return *materials_[triangle.material].source; }

 private:
    struct MaterialData {
        Bsdf bsdf;  ///< Without textures and vertex colors.
        const Material* source = nullptr;
        bool emissionVaries = false;
    };

    SurfaceTriangle makeTriangle(uint32_t i) const;
    glm::vec3 texturedEmission(uint32_t triangle, float u, float v) const;
    void applyTextures(const Hit& hit, SurfacePoint& point) const;
    glm::vec4 texCoordsAt(const Hit& hit) const;
    glm::vec4 lookUp(const TextureRef& ref, const glm::vec4& texCoords) const;

    const SceneState* state_;
    std::vector<SurfaceTriangle> triangles_;         ///< Empty for few rays.
    std::unordered_map<uint32_t, uint32_t> lights_;  ///< By triangle, for few rays.
    std::vector<MaterialData> materials_;
};

}  // namespace voxray::path_trace

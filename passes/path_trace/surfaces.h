#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "passes/path_trace/bsdf.h"
#include "scene/geometry.h"
#include "scene/surface_offset.h"
#include "trace/embree_scene.h"
#include "trace/ray.h"

namespace voxray::path_trace {

constexpr uint32_t kNoLight = 0xffffffffu;

/// What a path needs to know of a triangle, gathered in one cache line.
struct alignas(64) SurfaceTriangle {
    glm::vec3 corner{0.0f};
    float offset = 0.0f;  ///< Of its plane: planeOffset().
    glm::vec3 edge1{0.0f};
    uint32_t material = 0;
    glm::vec3 edge2{0.0f};
    uint32_t light = kNoLight;     ///< Patch among the lights, or kNoLight.
    glm::vec3 normal{0.0f, 1, 0};  ///< Geometric, unit length, on the front side.
    uint32_t isSimple = 0;         ///< 1: flat, no textures, no vertex colours.

    /// How far off the surface new rays start at a point of it, m.
    float offsetAt(const glm::vec3& position) const { return std::max(offset, pointOffset(position)); }
};

/// A point where a path scatters.
struct SurfacePoint {
    glm::vec3 position{0.0f};
    float offset = 0.0f;
    glm::vec3 faceNormal{0.0f};     ///< Geometric normal on the side of the incoming ray.
    glm::vec3 shadingNormal{0.0f};  ///< On the same side.
    Bsdf bsdf;

    /// Start of a ray that leaves on the side of the incoming one.
    glm::vec3 rayOrigin() const { return position + faceNormal * offset; }
};

/// Every triangle's and material's shading data. Thread-safe after construction.
class SurfaceTable {
 public:
    /// `state` must outlive this object. For few rays nothing is prepared: triangles are gathered as they are
    /// met.
    explicit SurfaceTable(const SceneState& state, RaysToCome rays = RaysToCome::Many);

    SurfaceTriangle triangle(uint32_t i) const { return triangles_.empty() ? gathered(i) : triangles_[i]; }
    size_t triangleCount() const { return state_->geometry.triangles.size(); }
    /// Makes a triangle part of a patch among the lights. Not thread-safe.
    void setLight(uint32_t triangle, uint32_t light);

    /// Geometry and material where a ray of unit `direction` hits.
    SurfacePoint at(const Hit& hit, const glm::vec3& direction) const;

    /// Radiance that leaves a triangle's emitting sides at barycentrics (u, v): none where the alpha mask
    /// cuts the surface away.
    glm::vec3 emission(uint32_t triangle, float u, float v) const {
        const MaterialData& m = materials_[state_->geometry.triangleMaterials[triangle]];
        return m.emissionVaries ? varyingEmission(triangle, u, v) : m.source->emission;
    }
    /// Whether a triangle's emission may differ from point to point.
    bool emissionVaries(const SurfaceTriangle& triangle) const {
        return materials_[triangle.material].emissionVaries;
    }
    /// Whether light leaves towards a unit `direction` that points away from the triangle.
    bool emitsTowards(const SurfaceTriangle& triangle, const glm::vec3& direction) const {
        return materials_[triangle.material].source->doubleSided ||
               glm::dot(triangle.normal, direction) > 0.0f;
    }
    const Material& material(const SurfaceTriangle& triangle) const {
        return *materials_[triangle.material].source;
    }

 private:
    struct MaterialData {
        Bsdf bsdf;  ///< Without textures and vertex colours.
        const Material* source = nullptr;
        bool emissionVaries = false;
    };

    SurfaceTriangle gathered(uint32_t i) const;
    glm::vec3 varyingEmission(uint32_t triangle, float u, float v) const;
    void shadeInDetail(const Hit& hit, SurfacePoint& point) const;
    glm::vec4 lookUp(const TextureRef& ref, const glm::vec4& texCoords) const;

    const SceneState* state_;
    std::vector<SurfaceTriangle> triangles_;         ///< Empty for few rays.
    std::unordered_map<uint32_t, uint32_t> lights_;  ///< By triangle, for few rays.
    std::vector<MaterialData> materials_;
};

}  // namespace voxray::path_trace

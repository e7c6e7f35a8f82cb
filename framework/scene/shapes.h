#pragma once

#include <string>

#include "scene/scene.h"

namespace voxray {

/// Builds a scene from simple shapes with flat or exact normals.
class SceneBuilder {
 public:
    explicit SceneBuilder(std::string name);

    /// Lambert: metallic 0, specular 0, roughness 1.
    uint32_t lambert(const std::string& name, const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0));
    uint32_t material(Material material);
    uint32_t mesh(Mesh mesh);
    void place(uint32_t mesh, int32_t node = -1);

    /// A parallelogram with its front towards cross(edgeU, edgeV).
    void quad(const std::string& name, const glm::vec3& corner, const glm::vec3& edgeU, const glm::vec3& edgeV,
              uint32_t material);
    using Corners = std::array<glm::vec3, 4>;
    /// Four quads between the edges of two quadrilaterals: a wall round a window, or walls between floor and
    /// ceiling. Fronts are towards cross(inner[1] - inner[0], outer[0] - inner[0]).
    void band(const std::string& name, const Corners& inner, const Corners& outer, uint32_t material);
    /// A box on `base` (the center of its bottom), rotated about +Y; fronts outwards.
    void box(const std::string& name, const glm::vec3& base, const glm::vec3& size, float angleRadians,
             uint32_t material);
    /// A closed axis-aligned room, fronts inwards. Materials in the order -x, +x, -y, +y, -z, +z; `none`
    /// omits a wall.
    void room(const glm::vec3& min, const glm::vec3& max, const std::array<uint32_t, 6>& materials);
    static constexpr uint32_t none = ~0u;

    void camera(const glm::vec3& position, const glm::vec3& target, float verticalFovDegrees,
                const glm::vec3& up = {0, 1, 0});
    void pointLight(const glm::vec3& position, const glm::vec3& intensity);
    void spotLight(const glm::vec3& position, const glm::vec3& direction, float innerDegrees, float outerDegrees,
                   const glm::vec3& intensity);
    void directionalLight(const glm::vec3& direction, const glm::vec3& irradiance);

    Scene& scene() { return *scene_; }
    /// The scene with its content hash. The builder is empty afterwards.
    std::shared_ptr<const Scene> finish();

 private:
    std::shared_ptr<Scene> scene_;
};

/// Appends a parallelogram with its front towards cross(edgeU, edgeV).
void appendQuad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& edgeU, const glm::vec3& edgeV);

/// A subdivided icosahedron of 20 * 4^subdivisions triangles with its vertices on the sphere.
/// @param inwards fronts and normals towards the center
/// @param smooth normals of the sphere at shared vertices; otherwise flat normals
Mesh sphereMesh(const std::string& name, const glm::vec3& center, float radius, uint32_t subdivisions,
                uint32_t material, bool inwards, bool smooth);

}  // namespace voxray

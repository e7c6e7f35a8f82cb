#pragma once

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <string>

#include "scene/import/notes.h"
#include "scene/import/textured_color.h"
#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray {

/// A scene while a reader of another renderer's files fills it. Transforms are to the world of the file.
class SceneImport {
 public:
    explicit SceneImport(const std::filesystem::path& path);
    SceneImport(const SceneImport&) = delete;
    SceneImport& operator=(const SceneImport&) = delete;

    Scene& scene() { return scene_; }
    ImportNotes& notes() { return notes_; }
    MemoryBudget& memory() { return memory_; }
    ColorImages& images() { return images_; }

    /// Mirrors all that is placed, x to -x: for files whose camera shows a mirrored image. Call it before all below.
    void mirror();
    /// From the file's world to the scene's: identity or that mirror.
    const glm::dmat4& world() const { return world_; }

    /// Stores a mesh in object space; its material must be stored already. Missing normals become flat, tangents for a
    /// normal map are made, invalid values repaired. @return nullopt: it has no triangles. @throws Error for indices
    /// out of range and positions that are not finite
    std::optional<uint32_t> addMesh(Mesh mesh);
    /// @throws Error for a transform that is not finite
    void place(uint32_t mesh, const glm::dmat4& toWorld, const std::string& name);

    /// A light at the origin that shines along +Z of its space.
    void addLight(Light light, const glm::dmat4& toWorld);
    /// A camera at the origin of its space that looks along +Z, +Y up. A mirrored image is not shown: see mirror().
    void addCamera(const std::string& name, const glm::dmat4& toWorld, float verticalFovRadians);
    /// Adds radiance from infinity to what there is already. A map is in the scene's world, as Environment says.
    /// See environmentMap()
    void addEnvironment(const Environment& environment);

    /// The scene with warnings and hash. @throws Error if it has no triangles
    std::shared_ptr<const Scene> finish();

 private:
    std::string file_;
    Scene scene_;
    ImportNotes notes_;
    MemoryBudget memory_;
    ColorImages images_{scene_, notes_, memory_};
    glm::dmat4 world_{1.0};
};

}  // namespace voxray

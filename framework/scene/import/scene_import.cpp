#include "scene/import/scene_import.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "scene/append_vertex.h"
#include "scene/content_hash.h"
#include "scene/import/environment.h"
#include "scene/mesh_repair.h"

namespace voxray {
namespace {

constexpr float kMaxRadiance = 1e30f;
/// All attributes of a vertex that is copied or split.
constexpr size_t kBytesPerVertex = 3 * sizeof(glm::vec4) + 3 * sizeof(glm::vec3);

template <typename Vector>
bool isFinite(const Vector& v) {
    for (int c = 0; c < int(Vector::length()); ++c)
        if (!std::isfinite(v[c])) return false;
    return true;
}

template <typename Vector>
size_t repair(std::vector<Vector>& values, const Vector& replacement) {
    size_t count = 0;
    for (Vector& v : values) {
        if (isFinite(v)) continue;
        v = replacement;
        ++count;
    }
    return count;
}

/// Drops a list of attributes that is not as long as the positions.
template <typename Vector>
void dropUnlessComplete(std::vector<Vector>& values, const Mesh& mesh, ImportNotes& notes) {
    if (values.empty() || values.size() == mesh.positions.size()) return;
    notes.add("attributes that differ in number from the vertices are left out", mesh.name);
    values.clear();
}

glm::vec3 limitedRadiance(const glm::vec3& v) {
    return glm::clamp(v, glm::vec3(0), glm::vec3(kMaxRadiance));
}

}  // namespace

SceneImport::SceneImport(const std::filesystem::path& path) : file_(path.string()) {
    scene_.name = oneLine(path.filename().string(), 200);
}

void SceneImport::mirror() {
    world_ = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    notes_.add("the camera shows a mirrored image: the scene is mirrored, x to -x", "");
}

std::optional<uint32_t> SceneImport::addMesh(Mesh mesh) {
    for (const glm::uvec3& t : mesh.triangles)
        if (std::max({t.x, t.y, t.z}) >= mesh.positions.size())
            throw Error("mesh '{}': an index is beyond its {} vertices", mesh.name, mesh.positions.size());
    if (mesh.triangles.empty()) {
        notes_.add("meshes without triangles are left out", mesh.name);
        return {};
    }
    dropUnlessComplete(mesh.normals, mesh, notes_);
    dropUnlessComplete(mesh.texCoords0, mesh, notes_);
    dropUnlessComplete(mesh.colors, mesh, notes_);
    dropUnusedVertices(mesh);
    for (const glm::vec3& position : mesh.positions)
        if (!isFinite(position)) throw Error("mesh '{}': it has positions that are not finite", mesh.name);
    if (repair(mesh.texCoords0, glm::vec2(0)) > 0)
        notes_.add("texture coordinates that are not finite are taken as 0", mesh.name);
    if (repair(mesh.colors, glm::vec4(1)) > 0) notes_.add("colours that are not finite are taken as 1", mesh.name);

    const Material& material = scene_.materials.at(mesh.material);
    if (limitColors(mesh, material) > 0)
        notes_.add("vertex colours are limited, so that they are from 0 to 1 times the base colour", mesh.name);
    if (mesh.normals.empty()) {
        memory_.reserve(3 * mesh.triangles.size(), kBytesPerVertex);
        makeFlatNormals(mesh);
    } else if (repairNormals(mesh) > 0) {
        notes_.add("normals that are not finite are taken from their triangles", mesh.name);
    }
    if (material.normalTexture.texture >= 0) {
        memory_.reserve(mesh.positions.size(), kBytesPerVertex);
        makeTangents(mesh, material.normalTexture.texCoord);
        // Mitsuba and pbrt: bitangent = normal x tangent, whatever the texture coordinates are
        for (glm::vec4& tangent : mesh.tangents) tangent.w = 1;
    }
    mesh.name = oneLine(mesh.name, 200);
    scene_.meshes.push_back(std::move(mesh));
    return uint32_t(scene_.meshes.size() - 1);
}

void SceneImport::place(uint32_t mesh, const glm::dmat4& toWorld, const std::string& name) {
    const glm::mat4 matrix(world_ * toWorld);
    for (int column = 0; column < 4; ++column)
        if (!isFinite(matrix[column])) throw Error("the transform of '{}' is not finite", name);
    memory_.reserve(1, sizeof(Node) + sizeof(Instance));
    Node node;
    node.name = oneLine(name, 200);
    node.matrix = matrix;
    scene_.nodes.push_back(std::move(node));
    scene_.instances.push_back({mesh, int32_t(scene_.nodes.size() - 1), -1});
}

void SceneImport::addLight(Light light, const glm::dmat4& toWorld) {
    const glm::dmat4 matrix = world_ * toWorld;
    light.position = glm::vec3(matrix[3]);
    light.direction = normalizedOrZero(glm::vec3(matrix[2]));
    const bool hasDirection = light.type == LightType::Point || glm::length(light.direction) > 0;
    if (!hasDirection || !isFinite(light.position) || !isFinite(light.direction) || !isFinite(light.intensity)) {
        notes_.add("lights whose place or intensity is not finite are left out", light.name);
        return;
    }
    light.intensity = limitedRadiance(light.intensity);
    light.name = oneLine(light.name, 200);
    scene_.lights.push_back(std::move(light));
}

void SceneImport::addCamera(const std::string& name, const glm::dmat4& toWorld, float verticalFovRadians) {
    const glm::dmat4 matrix = world_ * toWorld;
    const glm::dvec3 position(matrix[3]), z(matrix[2]), y(matrix[1]);
    const glm::dvec3 forward = glm::normalize(z);
    const glm::dvec3 up = glm::normalize(y - forward * glm::dot(forward, y));
    if (!isFinite(glm::vec3(position)) || !isFinite(forward) || !isFinite(up) ||
        !(verticalFovRadians > 0 && verticalFovRadians < 3.14f)) {
        notes_.add("cameras whose place or field of view is impossible are left out", name);
        return;
    }
    scene_.cameras.push_back({.name = oneLine(name, 200),
                              .verticalFovRadians = verticalFovRadians,
                              .position = glm::vec3(position),
                              .forward = glm::vec3(forward),
                              .up = glm::vec3(up)});
}

void SceneImport::addEnvironment(const Environment& environment) {
    if (!isFinite(environment.radiance)) {
        notes_.add("an environment whose radiance is not finite is left out", "");
        return;
    }
    Environment added = environment;
    added.radiance = limitedRadiance(added.radiance);
    scene_.environment = sumOfEnvironments(scene_.environment, added);
}

std::shared_ptr<const Scene> SceneImport::finish() {
    if (scene_.instances.empty())
        throw Error("{}: it has no triangles to render{}", file_,
                    notes_.lines().empty() ? "" : ": " + notes_.lines().front());
    for (const std::string& line : notes_.lines()) scene_.warnings.push_back(line);
    auto scene = std::make_shared<Scene>(std::move(scene_));
    scene->contentHash = hashScene(*scene);
    return scene;
}

}  // namespace voxray

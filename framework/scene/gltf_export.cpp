#include "scene/gltf_export.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "scene/load.h"

namespace voxray {
namespace {

/// A node whose -Z axis is `forward`.
tinygltf::Node nodeFacing(const std::string& name, const glm::vec3& position, const glm::vec3& forward,
                          const glm::vec3& up) {
    const glm::dvec3 z = -glm::normalize(glm::dvec3(forward));
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(up), z));
    const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
    tinygltf::Node node;
    node.name = name;
    node.translation = numbers(position);
    for (const double component : {q.x, q.y, q.z, q.w}) node.rotation.push_back(std::clamp(component, -1.0, 1.0));
    return node;
}

/// An axis that is far from parallel to the direction.
glm::vec3 anyUp(const glm::vec3& direction) {
    return std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
}

}  // namespace

GltfWriter::GltfWriter() {
    model_.asset.version = "2.0";
    model_.asset.generator = "voxray";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
}

int GltfWriter::addView(const void* data, size_t bytes, int target) {
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = bytes;
    view.target = target;
    const auto* begin = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), begin, begin + bytes);
    model_.bufferViews.push_back(std::move(view));
    return int(model_.bufferViews.size() - 1);
}

template <typename T>
int GltfWriter::addAccessor(const std::vector<T>& values, int type, int componentType, int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(values.data(), values.size() * sizeof(T), target);
    accessor.byteOffset = 0;
    accessor.normalized = false;
    accessor.count = values.size();
    accessor.type = type;
    accessor.componentType = componentType;
    accessor.sparse.isSparse = false;
    model_.accessors.push_back(std::move(accessor));
    return int(model_.accessors.size() - 1);
}

int GltfWriter::addNode(tinygltf::Node node) {
    model_.nodes.push_back(std::move(node));
    const int index = int(model_.nodes.size() - 1);
    model_.scenes[0].nodes.push_back(index);
    return index;
}

void GltfWriter::addInstance(const Geometry& geometry, const InstanceRange& range, const Mesh& mesh) {
    // The instance's range of each array.
    const auto vertices = std::span(geometry.attributes).subspan(range.firstVertex, range.vertexCount);
    const auto positionSpan = std::span(geometry.positions).subspan(range.firstVertex, range.vertexCount);
    const std::vector<glm::vec3> positions(positionSpan.begin(), positionSpan.end());
    std::vector<glm::uvec3> triangles;
    triangles.reserve(range.triangleCount);
    for (uint32_t i = 0; i < range.triangleCount; ++i)
        triangles.push_back(geometry.triangles[range.firstTriangle + i] - range.firstVertex);
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texCoords0;
    std::vector<glm::vec2> texCoords1;
    std::vector<glm::vec4> colors;
    for (const VertexAttributes& a : vertices) {
        normals.push_back(a.normal);
        tangents.push_back(a.tangent);
        texCoords0.emplace_back(a.texCoords.x, a.texCoords.y);
        texCoords1.emplace_back(a.texCoords.z, a.texCoords.w);
        colors.push_back(a.color);
    }

    // glTF requires bounds of positions.
    const int vertexData = TINYGLTF_TARGET_ARRAY_BUFFER;
    const int floats = TINYGLTF_COMPONENT_TYPE_FLOAT;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = int(mesh.material);
    primitive.attributes["POSITION"] = addAccessor(positions, TINYGLTF_TYPE_VEC3, floats, vertexData);
    Box bounds = Box::empty();
    for (const glm::vec3& p : positions) bounds.include(p);
    model_.accessors.back().minValues = numbers(bounds.min);
    model_.accessors.back().maxValues = numbers(bounds.max);
    primitive.attributes["NORMAL"] = addAccessor(normals, TINYGLTF_TYPE_VEC3, floats, vertexData);
    if (!mesh.tangents.empty())
        primitive.attributes["TANGENT"] = addAccessor(tangents, TINYGLTF_TYPE_VEC4, floats, vertexData);
    if (!mesh.texCoords0.empty() || !mesh.texCoords1.empty())
        primitive.attributes["TEXCOORD_0"] = addAccessor(texCoords0, TINYGLTF_TYPE_VEC2, floats, vertexData);
    if (!mesh.texCoords1.empty())
        primitive.attributes["TEXCOORD_1"] = addAccessor(texCoords1, TINYGLTF_TYPE_VEC2, floats, vertexData);
    if (!mesh.colors.empty())
        primitive.attributes["COLOR_0"] = addAccessor(colors, TINYGLTF_TYPE_VEC4, floats, vertexData);
    primitive.indices = addAccessor(triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    model_.accessors.back().count = 3 * triangles.size();

    tinygltf::Mesh out;
    out.name = mesh.name;
    out.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(out));
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = int(model_.meshes.size() - 1);
    addNode(std::move(node));
}

void GltfWriter::addLight(const Light& light) {
    // glTF's colour is at most 1; the intensity has the rest.
    const float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    tinygltf::Light out;
    out.name = light.name;
    out.color = numbers(strength > 0 ? light.intensity / strength : glm::vec3(1));
    out.intensity = double(strength);
    switch (light.type) {
        case LightType::Point:
            out.type = "point";
            break;
        case LightType::Spot:
            out.type = "spot";
            // The outer angle is at most pi/2, which floats round up; the inner one is below it.
            out.spot.outerConeAngle = std::min(double(light.outerConeAngle), M_PI / 2);
            out.spot.innerConeAngle =
                std::min(double(light.innerConeAngle), std::nextafter(out.spot.outerConeAngle, 0.0));
            break;
        case LightType::Directional:
            out.type = "directional";
            break;
    }
    model_.lights.push_back(std::move(out));
    tinygltf::Node node = nodeFacing(light.name, light.position, light.direction, anyUp(light.direction));
    setLight(node, int(model_.lights.size() - 1));
    addNode(std::move(node));
}

void GltfWriter::addCamera(const Camera& camera) {
    tinygltf::Camera out;
    out.name = camera.name;
    out.type = "perspective";
    out.perspective.yfov = double(camera.verticalFovRadians);
    // Planes beyond any scene; tinygltf would write an infinite far plane as an invalid zfar of 0.
    out.perspective.znear = 1e-3;
    out.perspective.zfar = 1e5;
    model_.cameras.push_back(std::move(out));
    tinygltf::Node node = nodeFacing(camera.name, camera.position, camera.forward, camera.up);
    node.camera = int(model_.cameras.size() - 1);
    addNode(std::move(node));
}

std::string GltfWriter::glb() {
    if (model_.buffers[0].data.size() > 0xf0000000u)
        throw Error("the scene has {} MiB of data, a .glb holds less than 4 GiB; export a smaller scene",
                    model_.buffers[0].data.size() >> 20);
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, out, false, true)) throw Error("the scene can't be written as .glb");
    return std::move(out).str();
}

void exportGlb(const SceneState& state, const std::filesystem::path& path) {
    GltfWriter writer;
    writer.addMaterials(*state.scene);
    for (const SceneState* exported : {&state, static_cast<const SceneState*>(state.panes.get())}) {
        if (!exported) continue;
        for (size_t i = 0; i < exported->geometry.instances.size(); ++i)
            writer.addInstance(exported->geometry, exported->geometry.instances[i],
                               exported->scene->meshes[exported->scene->instances[i].mesh]);
    }
    for (const Light& light : state.lights) writer.addLight(light);
    for (const Camera& camera : state.cameras) writer.addCamera(camera);
    writeFileAtomically(path, writer.glb());
}

}  // namespace voxray

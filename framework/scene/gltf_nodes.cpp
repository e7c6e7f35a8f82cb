#include "scene/gltf_nodes.h"

#include <algorithm>

#include "scene/gltf_accessor.h"
#include "scene/gltf_values.h"

namespace voxray {
namespace {

std::vector<int> rootsOf(const GltfFile& file) {
    const tinygltf::Model& model = file.model();
    if (!model.scenes.empty()) return file.at(model.scenes, std::max(model.defaultScene, 0), "scene").nodes;
    std::vector<bool> isChild(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) {
            file.at(model.nodes, child, "node");
            isChild[size_t(child)] = true;
        }
    std::vector<int> roots;
    for (size_t i = 0; i < model.nodes.size(); ++i)
        if (!isChild[i]) roots.push_back(int(i));
    return roots;
}

Node readNode(GltfFile& file, int index, int32_t parent) {
    const tinygltf::Node& source = file.at(file.model().nodes, index, "node");
    Node node;
    node.name = shortLine(source.name);
    node.parent = parent;
    const std::string what = fmt::format("node {} '{}'", index, node.name);
    if (!source.matrix.empty()) {
        if (source.matrix.size() != 16) file.fail("{}: its matrix has {} numbers", what, source.matrix.size());
        glm::mat4 m;
        for (int i = 0; i < 16; ++i)
            m[i / 4][i % 4] = checkedFloat(file, source.matrix[size_t(i)], -maxNumber, maxNumber, what + ": matrix");
        node.matrix = m;
        return node;
    }
    glm::vec4 rotation(0, 0, 0, 1);
    readVector(file, source.translation, node.translation, -maxNumber, maxNumber, what + ": translation", checkedFloat);
    readVector(file, source.scale, node.scale, -maxNumber, maxNumber, what + ": scale", checkedFloat);
    readVector(file, source.rotation, rotation, -1.01, 1.01, what + ": rotation", checkedFloat);
    const float length = glm::length(rotation);
    if (!(length > 0)) file.fail("{}: its rotation is zero", what);
    rotation /= length;
    node.rotation = glm::quat(rotation.w, rotation.x, rotation.y, rotation.z);
    return node;
}

std::string nameOf(const std::string& name, const std::string& nodeName, const char* kind, size_t number) {
    if (!name.empty()) return shortLine(name);
    return nodeName.empty() ? fmt::format("{} {}", kind, number) : shortLine(nodeName);
}

/// Reads an attribute of the instances of EXT_mesh_gpu_instancing; empty if missing.
AccessorValues instanceAttribute(GltfFile& file, const tinygltf::Value& attributes, const char* name,
                                 uint32_t components) {
    if (!attributes.Has(name)) return {};
    if (!attributes.Get(name).IsInt()) file.fail("EXT_mesh_gpu_instancing: {} is not an integer", name);
    return readAccessor(file, attributes.Get(name).GetNumberAsInt(), components, components, name);
}

}  // namespace

void readCamera(GltfFile& file, const tinygltf::Node& node, int32_t nodeIndex, Scene& scene) {
    if (node.camera < 0) return;
    const tinygltf::Camera& source = file.at(file.model().cameras, node.camera, "camera");
    Camera camera;
    camera.name = nameOf(source.name, node.name, "camera", scene.cameras.size());
    camera.node = nodeIndex;
    if (source.type != "perspective") {
        file.warn("camera '{}': orthographic cameras are not supported; left out", camera.name);
        scene.orthographicCameras.push_back(std::move(camera.name));
        return;
    }
    const double fov = source.perspective.yfov;
    if (!(fov > 0 && fov < 3.1415)) file.fail("camera '{}': yfov is {} radians; expected 0 to 3.14", camera.name, fov);
    camera.verticalFovRadians = float(fov);
    scene.cameras.push_back(std::move(camera));
}

void readLight(GltfFile& file, const tinygltf::Node& node, int32_t nodeIndex, Scene& scene) {
    const tinygltf::Value* index = extensionMember(node.extensions, "KHR_lights_punctual", "light");
    if (index == nullptr) return;
    if (!index->IsInt()) file.fail("KHR_lights_punctual.light is not an integer");
    const tinygltf::Light& source = file.at(file.model().lights, index->GetNumberAsInt(), "light");
    Light light;
    light.name = nameOf(source.name, node.name, "light", scene.lights.size());
    light.node = nodeIndex;
    const std::string what = fmt::format("light '{}'", light.name);
    if (source.type == "point")
        light.type = LightType::Point;
    else if (source.type == "spot")
        light.type = LightType::Spot;
    else if (source.type == "directional")
        light.type = LightType::Directional;
    else
        file.fail("{}: type '{}' is not one of glTF's", what, source.type);
    const float intensity = clampedFloat(file, source.intensity, 0, maxNumber, what + ": intensity");
    readVector(file, source.color, light.intensity, 0, maxNumber, what + ": color", clampedFloat);
    for (int i = 0; i < 3; ++i)
        light.intensity[i] =
            clampedFloat(file, double(light.intensity[i]) * intensity, 0, maxNumber, what + ": intensity");
    if (light.type == LightType::Spot) {
        light.outerConeAngle = clampedFloat(file, source.spot.outerConeAngle, 0, 1.5708, what + ": outerConeAngle");
        light.innerConeAngle = clampedFloat(file, source.spot.innerConeAngle, 0, 1.5708, what + ": innerConeAngle");
        if (light.innerConeAngle > light.outerConeAngle) {
            file.warn("{}: innerConeAngle is wider than outerConeAngle; both are taken as the latter", what);
            light.innerConeAngle = light.outerConeAngle;
        }
    }
    scene.lights.push_back(std::move(light));
}

std::vector<int> readNodes(GltfFile& file, Scene& scene) {
    // Depth first, children in the file's order; without recursion, since hierarchies can be deep.
    struct Visit {
        int index;
        int32_t parent;
    };
    std::vector<int> fileNodes;
    std::vector<bool> seen(file.model().nodes.size());
    std::vector<Visit> stack;
    const auto push = [&](const std::vector<int>& indices, int32_t parent) {
        for (auto i = indices.rbegin(); i != indices.rend(); ++i) stack.push_back({*i, parent});
    };
    push(rootsOf(file), -1);
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const tinygltf::Node& node = file.at(file.model().nodes, visit.index, "node");
        if (seen[size_t(visit.index)])
            file.fail("node {} has two parents or is below itself; nodes must form a tree", visit.index);
        seen[size_t(visit.index)] = true;
        const int32_t index = int32_t(scene.nodes.size());
        scene.nodes.push_back(readNode(file, visit.index, visit.parent));
        fileNodes.push_back(visit.index);
        push(node.children, index);
    }
    return fileNodes;
}

std::vector<int32_t> readInstanceNodes(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene) {
    const tinygltf::Value* attributes = extensionMember(source.extensions, "EXT_mesh_gpu_instancing", "attributes");
    if (attributes == nullptr) return {node};
    const std::string what = fmt::format("node '{}': EXT_mesh_gpu_instancing", scene.nodes[size_t(node)].name);
    const AccessorValues translations = instanceAttribute(file, *attributes, "TRANSLATION", 3);
    const AccessorValues rotations = instanceAttribute(file, *attributes, "ROTATION", 4);
    const AccessorValues scales = instanceAttribute(file, *attributes, "SCALE", 3);
    const size_t count = std::max({translations.count, rotations.count, scales.count});
    for (const AccessorValues* values : {&translations, &rotations, &scales})
        if (values->count != 0 && values->count != count)
            file.fail("{}: its attributes have {} and {} elements", what, values->count, count);

    // One node per instance, below the node itself
    file.reserve(count, sizeof(Node));
    std::vector<int32_t> instanceNodes;
    for (size_t i = 0; i < count; ++i) {
        Node instance;
        instance.name = scene.nodes[size_t(node)].name;
        instance.parent = node;
        glm::vec4 rotation(0, 0, 0, 1);
        for (uint32_t c = 0; c < 4; ++c) {
            if (rotations.count > 0) rotation[int(c)] = rotations.get(i, c);
            if (c == 3) break;
            if (translations.count > 0) instance.translation[int(c)] = translations.get(i, c);
            if (scales.count > 0) instance.scale[int(c)] = scales.get(i, c);
        }
        const float length = glm::length(rotation);
        if (!(length > 0 && length < float(maxNumber))) file.fail("{}: rotation {} is zero", what, i);
        rotation /= length;
        instance.rotation = glm::quat(rotation.w, rotation.x, rotation.y, rotation.z);
        instanceNodes.push_back(int32_t(scene.nodes.size()));
        scene.nodes.push_back(std::move(instance));
    }
    return instanceNodes;
}

}  // namespace voxray

#include "scene/load.h"

#include <algorithm>
#include <map>

#include "base/interrupt.h"
#include "scene/content_hash.h"
#include "scene/gltf_file.h"
#include "scene/gltf_material.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_morph.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_skin.h"
#include "scene/gltf_values.h"

namespace voxray {
namespace {

/// The scene's meshes of a mesh in the file.
struct MeshRange {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// A mesh of the file, and its morph targets' weights.
using MeshKey = std::pair<int, FixedWeights>;

MeshRange readMesh(GltfFile& file, const MeshKey& key, MaterialReader& materials, Scene& scene) {
    const auto& [index, weights] = key;
    const tinygltf::Mesh& source = file.model().meshes[size_t(index)];
    MeshRange range{uint32_t(scene.meshes.size()), 0};
    for (size_t i = 0; i < source.primitives.size(); ++i) {
        const tinygltf::Primitive& primitive = source.primitives[i];
        const std::string what = fmt::format("mesh {} '{}', primitive {}", index, shortLine(source.name), i);
        const uint32_t material = materials.material(primitive.material);
        Mesh mesh = readPrimitive(file, primitive, weights, scene.materials[material], what);
        if (mesh.triangles.empty()) continue;
        mesh.name = shortLine(source.name);
        mesh.material = material;
        scene.meshes.push_back(std::move(mesh));
        ++range.count;
    }
    return range;
}

/// The skin of a node's meshes; -1: they are transformed by the node.
int32_t skinOf(GltfFile& file, const tinygltf::Node& node, const MeshRange& range, SkinReader& skins,
               const Scene& scene) {
    if (node.skin < 0 || range.count == 0) return -1;
    const std::string what = fmt::format("node '{}'", shortLine(node.name));
    const int32_t skin = skins.skin(node.skin);
    for (uint32_t m = range.first; skin >= 0 && m < range.first + range.count; ++m) {
        skins.check(scene.meshes[m], skin, what);
        if (!scene.meshes[m].skinWeights.empty()) continue;
        file.warn("{}: its mesh has no JOINTS_0 and WEIGHTS_0 for its skin; the node places it", what);
        return -1;
    }
    return skin;
}

/// Whether KHR_node_visibility hides each node of the scene, itself or by an ancestor.
std::vector<bool> hiddenNodes(GltfFile& file, const std::vector<int>& fileNodes, const Scene& scene) {
    std::vector<bool> hidden(fileNodes.size());
    for (size_t i = 0; i < fileNodes.size(); ++i) {
        const int32_t parent = scene.nodes[i].parent;
        const tinygltf::Value* visible =
            extensionMember(file.model().nodes[size_t(fileNodes[i])].extensions, "KHR_node_visibility", "visible");
        const bool isHidden = visible != nullptr && visible->IsBool() && !visible->Get<bool>();
        if (isHidden) file.warn("node '{}': KHR_node_visibility hides it; left out", scene.nodes[i].name);
        hidden[i] = isHidden || (parent >= 0 && hidden[size_t(parent)]);
    }
    return hidden;
}

/// Why there is nothing to render. @param hasMeshes whether any node has a mesh, which was ignored
std::string emptyCause(const GltfFile& file, bool hasMeshes) {
    const tinygltf::Model& model = file.model();
    if (model.meshes.empty()) return "it has no meshes";
    if (hasMeshes && !file.warnings().empty()) return file.warnings().back();
    const size_t number = size_t(std::max(model.defaultScene, 0));
    if (number >= model.scenes.size()) return "none of its nodes has a mesh";
    return fmt::format("none of the nodes of scene {} '{}' has a mesh{}", number, shortLine(model.scenes[number].name),
                       model.scenes.size() > 1 ? "; set \"scene\" in the file to another one" : "");
}

std::shared_ptr<const Scene> load(const std::filesystem::path& path) {
    GltfFile file(path);
    auto scene = std::make_shared<Scene>();
    scene->name = shortLine(path.filename().string());
    MaterialReader materials(file, *scene);
    std::map<MeshKey, MeshRange> meshes;

    // Read nodes with their meshes; shared meshes are read once.
    const std::vector<int> fileNodes = readNodes(file, *scene);
    const std::vector<bool> hidden = hiddenNodes(file, fileNodes, *scene);
    SkinReader skins(file, fileNodes, *scene);
    MorphReader morphs(file, *scene);
    for (size_t i = 0; i < fileNodes.size(); ++i) {
        const tinygltf::Node& node = file.model().nodes[size_t(fileNodes[i])];
        if (interruptRequested()) throw Interrupted();
        readCamera(file, node, int32_t(i), *scene);
        if (hidden[i]) continue;
        readLight(file, node, int32_t(i), *scene);
        if (node.mesh < 0) continue;
        const MeshKey key{node.mesh, morphs.weights(fileNodes[i])};
        if (!meshes.contains(key)) meshes[key] = readMesh(file, key, materials, *scene);
        const MeshRange& range = meshes[key];
        const int32_t skin = skinOf(file, node, range, skins, *scene);
        const int32_t morph = morphs.channel(fileNodes[i]);
        for (const int32_t instanceNode : readInstanceNodes(file, node, int32_t(i), *scene))
            for (uint32_t m = 0; m < range.count; ++m)
                scene->instances.push_back({range.first + m, instanceNode, skin, morph});
    }
    if (scene->instances.empty()) {
        const bool hasMeshes = std::any_of(fileNodes.begin(), fileNodes.end(),
                                           [&](int node) { return file.model().nodes[size_t(node)].mesh >= 0; });
        file.fail("it has no triangles to render: {}", emptyCause(file, hasMeshes));
    }
    readAnimations(file, fileNodes, *scene);
    materials.decodeTextures();
    scene->warnings = file.warnings();
    scene->contentHash = hashScene(*scene);
    return scene;
}

}  // namespace

std::shared_ptr<const Scene> loadGltf(const std::filesystem::path& path) {
    try {
        return load(path);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error("{}: it can't be loaded: {}", path.string(), shortLine(error.what()));
    }
}

}  // namespace voxray

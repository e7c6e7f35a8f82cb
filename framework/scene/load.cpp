#include "scene/load.h"

#include <map>

#include "base/interrupt.h"
#include "scene/content_hash.h"
#include "scene/gltf_file.h"
#include "scene/gltf_material.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_nodes.h"

namespace voxray {
namespace {

/// Meshes of the file that were read already: where they begin in the scene, and how many there are.
struct MeshRange {
    uint32_t first = 0;
    uint32_t count = 0;
};

MeshRange readMesh(GltfFile& file, int index, MaterialReader& materials, Scene& scene) {
    const tinygltf::Mesh& source = file.at(file.model().meshes, index, "mesh");
    MeshRange range{uint32_t(scene.meshes.size()), 0};
    for (size_t i = 0; i < source.primitives.size(); ++i) {
        const tinygltf::Primitive& primitive = source.primitives[i];
        const std::string what = fmt::format("mesh {} '{}', primitive {}", index, shortLine(source.name), i);
        const uint32_t material = materials.material(primitive.material);
        Mesh mesh = readPrimitive(file, primitive, scene.materials[material], what);
        if (mesh.triangles.empty()) continue;
        mesh.name = shortLine(source.name);
        mesh.material = material;
        scene.meshes.push_back(std::move(mesh));
        ++range.count;
        if (!primitive.targets.empty())
            file.warn("mesh '{}': morph targets are not supported; its base shape is used", source.name);
    }
    return range;
}

std::shared_ptr<const Scene> load(const std::filesystem::path& path) {
    GltfFile file(path);
    auto scene = std::make_shared<Scene>();
    scene->name = shortLine(path.filename().string());
    MaterialReader materials(file, *scene);
    std::map<int, MeshRange> meshes;

    // Read nodes, and what hangs on them; a mesh is read once, however many nodes share it.
    const std::vector<int> fileNodes = readNodes(file, *scene);
    for (size_t i = 0; i < fileNodes.size(); ++i) {
        const tinygltf::Node& node = file.model().nodes[size_t(fileNodes[i])];
        readCameraAndLight(file, node, int32_t(i), *scene);
        if (interruptRequested()) throw Interrupted();
        if (node.mesh < 0) continue;
        if (!meshes.contains(node.mesh)) meshes[node.mesh] = readMesh(file, node.mesh, materials, *scene);
        const MeshRange& range = meshes[node.mesh];
        for (uint32_t m = 0; m < range.count; ++m) scene->instances.push_back({range.first + m, int32_t(i)});
        if (node.skin >= 0) file.warn("node '{}': skins are not supported; its base pose is used", node.name);
    }
    if (scene->instances.empty()) file.fail("it has no triangles to render");
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

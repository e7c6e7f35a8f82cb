#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// Reads the nodes of the default scene (else scene 0, else all roots), parents first.
/// @return index in the file of each node of the scene
/// @throws Error for cycles, nodes with two parents, transforms that are not finite.
std::vector<int> readNodes(GltfFile& file, Scene& scene);

/// Reads all animations of those nodes' transforms, played together; MorphReader reads those of weights.
/// @param fileNodes as readNodes returned them
void readAnimations(GltfFile& file, const std::vector<int>& fileNodes, Scene& scene);

/// Adds the camera of a node; orthographic ones are ignored with a warning.
void readCamera(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene);

/// Adds the light of a node.
void readLight(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene);

/// Nodes of a mesh's instances: the node itself, or nodes added below it for EXT_mesh_gpu_instancing.
std::vector<int32_t> readInstanceNodes(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene);

}  // namespace voxray

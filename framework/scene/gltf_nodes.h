#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// Reads the nodes of the default scene (else scene 0, else all roots), parents first.
/// @return for each node of the scene its index in the file
/// @throws Error for cycles, nodes with two parents, transforms that are not finite.
std::vector<int> readNodes(GltfFile& file, Scene& scene);

/// Reads all animations of those nodes, played together.
/// @param fileNodes as readNodes returned them
void readAnimations(GltfFile& file, const std::vector<int>& fileNodes, Scene& scene);

/// Adds the camera of a node. An orthographic one is left out, with a warning.
void readCamera(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene);

/// Adds the light of a node.
void readLight(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene);

/// Where a node places its mesh: itself, or nodes that are added below it for EXT_mesh_gpu_instancing.
std::vector<int32_t> readPlaces(GltfFile& file, const tinygltf::Node& source, int32_t node, Scene& scene);

}  // namespace voxray

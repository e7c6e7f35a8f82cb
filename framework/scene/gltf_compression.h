#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "scene/gltf_data.h"

/// Decoders of compressed glTF: they replace compressed data, so that readers see plain glTF.
namespace voxray {

/// Counts memory before its allocation: elements, bytes per element. @throws Error if it is too much
using ReserveMemory = std::function<void(uint64_t, uint64_t)>;

/// Buffer views of EXT_meshopt_compression become views of new buffers.
/// @throws Error naming the view that is broken
void expandMeshopt(nlohmann::json& root, GltfBuffers& buffers, const ReserveMemory& reserve);

/// Primitives of KHR_draco_mesh_compression get accessors to new buffers.
/// @throws Error naming the primitive that is broken
void expandDraco(nlohmann::json& root, GltfBuffers& buffers, const ReserveMemory& reserve);

}  // namespace voxray

#pragma once

#include <string>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// Reads a primitive's vertices and triangles; normals are always there afterwards, tangents where the
/// material has a normal map. A primitive without triangles gives an empty mesh and a warning.
/// Vertices that no triangle has are left out.
/// @param morphWeights of the primitive's targets; missing ones are 0
/// @param what names the primitive in messages
/// @throws Error for indices outside of the vertices, positions that are not finite, attributes of unequal
/// length.
Mesh readPrimitive(GltfFile& file, const tinygltf::Primitive& primitive,
                   const std::vector<double>& morphWeights, const Material& material,
                   const std::string& what);

}  // namespace voxray

#pragma once

#include <string>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// Reads a primitive's vertices and triangles. Missing normals are computed, and tangents if the material has
/// a normal map; unused vertices are dropped. A primitive without triangles gives an empty mesh and a
/// warning.
/// @param morphWeights of the primitive's targets; missing ones are 0
/// @param what names the primitive in messages
/// @throws Error for indices outside of the vertices, positions that are not finite, attributes of unequal
/// length.
Mesh readPrimitive(GltfFile& file, const tinygltf::Primitive& primitive, const std::vector<double>& morphWeights,
                   const Material& material, const std::string& what);

}  // namespace voxray

#pragma once

#include <string>

#include "scene/gltf_file.h"
#include "scene/gltf_morph.h"
#include "scene/scene.h"

namespace voxray {

/// Reads a primitive's vertices and triangles. Missing normals are computed, and tangents if the material has
/// a normal map; unused vertices are dropped. A primitive without triangles gives an empty mesh and a
/// warning.
/// @param weights of its morph targets, which are applied; not set: the mesh keeps its targets
/// @param what names the primitive in messages
/// @throws Error for indices outside of the vertices, positions that are not finite, attributes of unequal
/// length.
Mesh readPrimitive(GltfFile& file, const tinygltf::Primitive& primitive, const FixedWeights& weights,
                   const Material& material, const std::string& what);

}  // namespace voxray

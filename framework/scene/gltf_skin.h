#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

/// Deformation of meshes by skins.
namespace voxray {

/// Reads all pairs JOINTS_n and WEIGHTS_n; weights are normalized to sum to 1. @throws Error
void readSkinWeights(GltfFile& file, const tinygltf::Primitive& primitive, Mesh& mesh, const std::string& what);

/// Reads the file's skins into the scene's, once each.
class SkinReader {
 public:
    /// @param fileNodes as readNodes returned them
    SkinReader(GltfFile& file, const std::vector<int>& fileNodes, Scene& scene);

    /// Index in the scene of a skin of the file; -1 with a warning if a joint is not in the scene.
    /// @throws Error for a skin without joints or with too few matrices
    int32_t skin(int index);

    /// @throws Error if a mesh has a joint that its skin lacks
    void check(const Mesh& mesh, int32_t skin, const std::string& what) const;

 private:
    GltfFile& file_;
    Scene& scene_;
    std::vector<int32_t> sceneNodes_;  ///< Indexed by the file's nodes; -1: not in the scene.
    std::map<int, int32_t> skins_;
};

}  // namespace voxray

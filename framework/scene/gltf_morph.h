#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

/// Morph targets, their weights and the animation of these (glTF 2.0, sections 3.7.2.2 and 3.11).
namespace voxray {

/// Weights of a mesh's morph targets, one for each; not set: they are animated.
using FixedWeights = std::optional<std::vector<float>>;

/// Reads a primitive's targets into a mesh whose other attributes have been read. Those of weight 0 are left out.
/// @throws Error if a target differs in length from the positions, or is not finite
void readMorphTargets(GltfFile& file, const tinygltf::Primitive& primitive, const FixedWeights& weights, Mesh& mesh,
                      const std::string& what);

/// Gives a mesh the shape of these weights and takes its targets away.
void applyMorphTargets(const std::vector<float>& weights, Mesh& mesh);

/// Reads weights of nodes, and their animations into the scene's.
class MorphReader {
 public:
    MorphReader(GltfFile& file, Scene& scene);

    /// Weights that a node gives its mesh. A node's weights override those of its mesh.
    /// @throws Error if their number is not that of the targets, or primitives differ in the number of targets
    FixedWeights weights(int node);

    /// Index into Scene::morphs of a node's animated weights; -1: they are not animated. @throws Error
    int32_t channel(int node);

 private:
    /// A sampler, and the name of its animation.
    struct Source {
        const tinygltf::AnimationSampler* sampler = nullptr;
        std::string what;
    };

    size_t targetCount(int mesh) const;

    GltfFile& file_;
    Scene& scene_;
    std::map<int, Source> sources_;  ///< By node of the file.
};

}  // namespace voxray

#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/geometry.h"
#include "scene/tiny_gltf.h"

namespace voxray {

/// A vector's components, as glTF has them.
template <typename Vector>
std::vector<double> numbers(const Vector& v) {
    std::vector<double> out;
    for (int i = 0; i < int(Vector::length()); ++i) out.push_back(double(v[i]));
    return out;
}

/// Builds a glTF model with all of its data in one buffer.
class GltfWriter {
 public:
    GltfWriter();

    /// Adds materials, samplers, textures and images of a scene, in the scene's order.
    void addMaterials(const Scene& scene);
    /// Adds a mesh and its node: the triangles of one instance, in world space, with the attributes of the
    /// instance's mesh.
    void addInstance(const Geometry& geometry, const InstanceRange& range, const Mesh& mesh);
    void addLight(const Light& light);
    void addCamera(const Camera& camera);

    /// The model as a .glb file. @throws Error if it has 4 GiB or more.
    std::string glb();

 private:
    int addView(const void* data, size_t bytes, int target);
    template <typename T>
    int addAccessor(const std::vector<T>& values, int type, int componentType, int target);
    int addNode(tinygltf::Node node);
    void addTexture(const Texture& texture);
    template <typename Info>
    Info textureInfo(const TextureRef& ref);
    /// Adds an extension, and its name to those that the file uses.
    void extend(tinygltf::ExtensionMap& extensions, const char* name, tinygltf::Value::Object members);

    tinygltf::Model model_;
};

}  // namespace voxray

#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace voxray {

/// Reads the used materials into the scene, and their images as textures.
class MaterialReader {
 public:
    MaterialReader(GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

    /// Index in the scene of a material of the file; -1 is glTF's default material. @throws Error
    uint32_t material(int index);

    /// Decodes the images of all materials read so far. @throws Error for an image that is missing or broken.
    void decodeTextures();

 private:
    /// Image, sRGB, wrap modes, filter.
    using TextureKey = std::tuple<int, bool, Wrap, Wrap, TexelFilter>;

    Material read(int index);
    float readIor(const tinygltf::Material& source, const std::string& what);
    TextureRef texture(int index, int texCoord, const tinygltf::ExtensionMap& extensions, bool srgb,
                       const std::string& what);
    Wrap wrap(int mode);
    TexelFilter filter(const tinygltf::Sampler& sampler);

    GltfFile& file_;
    Scene& scene_;
    std::map<int, uint32_t> materials_;
    std::map<TextureKey, int32_t> textures_;
    std::vector<int> images_;  ///< Image of each texture of the scene.
};

}  // namespace voxray

#pragma once

// Includes tinygltf, configured without file access and image decoding.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

namespace voxray {

/// Sets a node's light: as an extension, and since tinygltf 2.9 also as a member, without which the extension
/// is not written.
template <typename Node>
void setLight(Node& node, int light) {
    node.extensions["KHR_lights_punctual"] =
        tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(light)}});
    if constexpr (requires { node.light; }) node.light = light;
}

}  // namespace voxray

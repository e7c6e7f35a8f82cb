#pragma once

// The one place that includes tinygltf. It reads and writes no files and decodes no images by itself.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

namespace voxray {

/// Gives a node the light with that index: as an extension, and from tinygltf 2.9 on as a member, too,
/// without which the extension is not written.
template <typename Node>
void setLight(Node& node, int light) {
    node.extensions["KHR_lights_punctual"] =
        tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(light)}});
    if constexpr (requires { node.light; }) node.light = light;
}

}  // namespace voxray

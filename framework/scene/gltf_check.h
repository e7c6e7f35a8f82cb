#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxray {

/// What a glTF file's outside says, checked before a parser sees it.
struct GltfOutline {
    bool binary = false;
    std::vector<std::string> unknownExtensions;  ///< Used, not required.
};

/// Checks what tinygltf takes on trust: chunk lengths, nesting, versions, URIs, sizes of buffers, and where
/// images lie in them. @throws Error without the file's name.
GltfOutline checkGltf(std::span<const uint8_t> file);

}  // namespace voxray

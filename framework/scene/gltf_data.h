#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxray {

struct GltfContainer;

/// An image's file as it stands in the scene's files, not decoded.
struct EncodedImage {
    std::string name;
    std::string uri;  ///< Empty for images in buffers and data URIs.
    std::vector<uint8_t> bytes;
    std::string fault;  ///< Why there are no bytes.
};

using GltfBuffers = std::vector<std::vector<uint8_t>>;

/// Fetches all buffers: from the BIN chunk, data URIs and files of the folder. Those that
/// EXT_meshopt_compression marks as a fallback stay empty.
/// @throws Error naming the buffer that is missing or too short
GltfBuffers readBuffers(const GltfContainer& container, const std::filesystem::path& folder);

/// Fetches all images. A missing file is a fault of that image, which may not be used.
/// @throws Error for a URI that leaves the folder, a buffer view that is not there
std::vector<EncodedImage> readImages(const nlohmann::json& root, const GltfBuffers& buffers,
                                     const std::filesystem::path& folder);

/// Bytes of a buffer view. @throws Error where they are not there
std::vector<uint8_t> viewBytes(const nlohmann::json& root, const GltfBuffers& buffers, uint64_t view);

}  // namespace voxray

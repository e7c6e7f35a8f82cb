#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxray {

struct GltfContainer;

/// An encoded image.
struct EncodedImage {
    std::string name;
    std::string uri;  ///< Empty for images in buffers and data URIs.
    std::vector<uint8_t> bytes;
    std::string fault;  ///< Reason if there are no bytes.
};

using GltfBuffers = std::vector<std::vector<uint8_t>>;

/// Reads all buffers: from the BIN chunk, data URIs and files of the folder. Fallback buffers of
/// EXT_meshopt_compression stay empty.
/// @throws Error naming the buffer that is missing or too short
GltfBuffers readBuffers(const GltfContainer& container, const std::filesystem::path& folder);

/// Reads all images. A missing file is a fault of that image, which may be unused.
/// @throws Error for a URI that leaves the folder, or a missing buffer view
std::vector<EncodedImage> readImages(const nlohmann::json& root, const GltfBuffers& buffers,
                                     const std::filesystem::path& folder);

/// Bytes of a buffer view. @throws Error if they are out of bounds
std::vector<uint8_t> viewBytes(const nlohmann::json& root, const GltfBuffers& buffers, uint64_t view);

}  // namespace voxray

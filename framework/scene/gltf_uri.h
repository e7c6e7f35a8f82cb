#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxray {

/// Bytes of a URI: of a data URI, with or without MIME type and base64, or of a file in the folder or below.
/// Percent codes are decoded (RFC 3986); where no such file is there, the name as it stands is tried, and
/// backslashes as separators.
/// @throws Error for a URI that leaves the folder, a data URI that is broken, and a file that can't be read
std::vector<uint8_t> readUri(const std::string& uri, const std::filesystem::path& folder);

/// The file that a URI names, empty where there is none. @throws Error as readUri()
std::filesystem::path findUri(const std::string& uri, const std::filesystem::path& folder);

bool isDataUri(const std::string& uri);

}  // namespace voxray

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxray {

/// Bytes of a data URI, with or without MIME type and base64, or of a file in the folder or below. Percent
/// codes are decoded (RFC 3986); if there is no such file, the undecoded name is tried, and backslashes as
/// separators.
/// @throws Error for a URI that leaves the folder, an invalid data URI, and a file that can't be read
std::vector<uint8_t> readUri(const std::string& uri, const std::filesystem::path& folder);

/// The file of a URI, empty if there is none. @throws Error as readUri()
std::filesystem::path findUri(const std::string& uri, const std::filesystem::path& folder);

bool isDataUri(const std::string& uri);

}  // namespace voxray

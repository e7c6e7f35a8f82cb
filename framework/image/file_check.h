#pragma once

#include <cstdint>
#include <span>
#include <string>

/// What is looked at in PNG and JPEG files before a decoder sees them. Internal to the image layer.
namespace voxray {

bool isJpeg(std::span<const uint8_t> bytes);
bool isPng(std::span<const uint8_t> bytes);
bool isWebp(std::span<const uint8_t> bytes);

/// Whether the end marker is there; a cut-off JPEG decodes to grey without complaint.
bool jpegEnds(std::span<const uint8_t> bytes);

/// How to convert a picture of another format, which begins its own clause; empty where the format is
/// unknown.
std::string adviceFor(std::span<const uint8_t> bytes);

/// Refuses PNG and JPEG files without their end, and PNG files whose chunks are damaged: decoders speak on
/// stderr of such files, or stay silent and decode a part. @throws Error that begins with `name`.
void checkWhole(std::span<const uint8_t> bytes, const std::string& name);

}  // namespace voxray

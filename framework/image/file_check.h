#pragma once

#include <cstdint>
#include <span>
#include <string>

/// Checks of PNG and JPEG files before decoding. Internal to the image layer.
namespace voxray {

bool isJpeg(std::span<const uint8_t> bytes);
bool isPng(std::span<const uint8_t> bytes);
bool isWebp(std::span<const uint8_t> bytes);

/// Whether the end marker exists; truncated JPEGs decode to grey without an error.
bool hasJpegEnd(std::span<const uint8_t> bytes);

/// Clause on how to convert an image of an unsupported format; empty for an unknown format.
std::string adviceFor(std::span<const uint8_t> bytes);

/// Rejects truncated PNG and JPEG files and corrupt PNG chunks, which decoders report on stderr or ignore.
/// @throws Error that begins with `name`.
void checkIntegrity(std::span<const uint8_t> bytes, const std::string& name);

}  // namespace voxray

#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace voxray {

/// The JSON and binary chunks of a glTF file.
struct GltfContainer {
    nlohmann::json root;           ///< An object.
    bool binary = false;           ///< .glb
    std::span<const uint8_t> bin;  ///< BIN chunk of a .glb; points into the file's bytes.
};

/// Reads JSON and chunks of a .gltf or .glb. Whole numbers written as 3.0 become integers.
/// @throws Error without the file's name for broken chunks and JSON, and for text nested too deeply.
GltfContainer openGltf(std::span<const uint8_t> file);

/// An array of objects in an object; empty if missing. @throws Error
const nlohmann::json& objects(const nlohmann::json& object, const char* key);

/// A non-negative integer member. @throws Error if it has another type, or is missing without a default.
uint64_t unsignedMember(const nlohmann::json& object, const char* key, const std::string& what, int64_t fallback = -1);

/// A member of an extension of an object, or nullptr.
const nlohmann::json* extensionOf(const nlohmann::json& object, const char* extension);

}  // namespace voxray

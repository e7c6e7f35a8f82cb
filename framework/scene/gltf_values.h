#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/value_ranges.h"

namespace voxray {

/// Converts a double to a finite float in [min, max]. @throws Error naming it
inline float checkedFloat(const GltfFile& file, double value, double min, double max,
                          const std::string& what) {
    if (!(value >= min && value <= max)) file.fail("{} is {}; expected {} to {}", what, value, min, max);
    return float(value);
}

/// Upper bound of numbers, far below float's maximum, so that products are finite.
constexpr double maxNumber = 1e30;

/// Reads an array of the vector's length; an empty one keeps the default. @throws Error
template <typename Vector>
void readVector(const GltfFile& file, const std::vector<double>& values, Vector& out, double min, double max,
                const std::string& what) {
    if (values.empty()) return;
    if (values.size() != size_t(Vector::length()))
        file.fail("{} has {} numbers; expected {}", what, values.size(), int(Vector::length()));
    for (int i = 0; i < int(Vector::length()); ++i)
        out[i] = checkedFloat(file, values[size_t(i)], min, max, what);
}

/// A member of an extension's object, or nullptr.
inline const tinygltf::Value* extensionMember(const tinygltf::ExtensionMap& extensions, const char* extension,
                                              const char* member) {
    const auto entry = extensions.find(extension);
    if (entry == extensions.end() || !entry->second.Has(member)) return nullptr;
    return &entry->second.Get(member);
}

/// Reads a number of an extension, clamped to a range; a missing one keeps the default. @param owner named in
/// warnings. @throws Error
inline void readExtension(GltfFile& file, const std::string& owner, const tinygltf::ExtensionMap& extensions,
                          const char* extension, const char* member, double min, double max, float& out) {
    const tinygltf::Value* value = extensionMember(extensions, extension, member);
    if (value == nullptr) return;
    const std::string what = owner + ": " + extension + "." + member;
    if (!value->IsNumber()) file.fail("{} is not a number", what);
    out = limited(file, value->GetNumberAsDouble(), min, max, what);
}

/// Reads a vector likewise. @throws Error
template <typename Vector>
void readExtensionVector(GltfFile& file, const std::string& owner, const tinygltf::ExtensionMap& extensions,
                         const char* extension, const char* member, double min, double max, Vector& out) {
    const tinygltf::Value* value = extensionMember(extensions, extension, member);
    if (value == nullptr) return;
    const std::string what = owner + ": " + extension + "." + member;
    std::vector<double> numbers;
    for (size_t i = 0; i < value->ArrayLen(); ++i) {
        if (!value->Get(int(i)).IsNumber()) file.fail("{} is not an array of numbers", what);
        numbers.push_back(value->Get(int(i)).GetNumberAsDouble());
    }
    if (numbers.empty()) file.fail("{} is not an array of numbers", what);
    readLimited(file, numbers, out, min, max, what);
}

}  // namespace voxray

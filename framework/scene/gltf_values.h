#pragma once

#include <string>
#include <vector>

#include "scene/gltf_file.h"

namespace voxray {

/// Upper bound of numbers, far below float's maximum, so that products are finite.
constexpr double maxNumber = 1e30;

/// Converts a double to a finite float in [min, max]. @throws Error naming it
inline float checkedFloat(GltfFile& file, double value, double min, double max, const std::string& what) {
    if (!(value >= min && value <= max)) file.fail("{} is {}; expected {} to {}", what, value, min, max);
    return float(value);
}

/// Clamps a value of the file to [min, max], with a warning that names it. NaN becomes `min`.
inline float clampedFloat(GltfFile& file, double value, double min, double max, const std::string& what) {
    if (value >= min && value <= max) return float(value);
    const double nearest = value > max ? max : min;
    file.warn("{} is {}, not from {} to {}; taken as {}", what, value, min, max, nearest);
    return float(nearest);
}

/// Reads an array of the vector's length with `convert`, checkedFloat() or clampedFloat(), for each number;
/// an empty one keeps the default. @throws Error for another length
template <typename Vector>
void readVector(GltfFile& file, const std::vector<double>& values, Vector& out, double min, double max,
                const std::string& what, decltype(clampedFloat) convert) {
    if (values.empty()) return;
    if (values.size() != size_t(Vector::length()))
        file.fail("{} has {} numbers; expected {}", what, values.size(), int(Vector::length()));
    for (int i = 0; i < int(Vector::length()); ++i) out[i] = convert(file, values[size_t(i)], min, max, what);
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
    out = clampedFloat(file, value->GetNumberAsDouble(), min, max, what);
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
    readVector(file, numbers, out, min, max, what, clampedFloat);
}

}  // namespace voxray

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voxray {

enum class PlyType : uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Bytes of a value.
uint32_t sizeOf(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    bool isList = false;
    PlyType countType = PlyType::Uint8;  ///< Of a list's length.
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Index of the first property with one of the names; -1: none.
    int find(std::initializer_list<std::string_view> names) const;
};

enum class PlyFormat : uint8_t { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
};

/// Reads the header at the front of a file and removes it. @throws Error without the file's name
PlyHeader takePlyHeader(std::string_view& text);

}  // namespace voxray

#include "scene/import/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "base/error.h"

namespace voxray {
namespace {

constexpr size_t kMaxWords = 1000;  ///< Elements and properties of a header.

struct TypeName {
    std::string_view name, otherName;
    PlyType type;
    uint32_t bytes;
};
constexpr std::array<TypeName, 8> kTypes{{
    {"char", "int8", PlyType::Int8, 1},
    {"uchar", "uint8", PlyType::Uint8, 1},
    {"short", "int16", PlyType::Int16, 2},
    {"ushort", "uint16", PlyType::Uint16, 2},
    {"int", "int32", PlyType::Int32, 4},
    {"uint", "uint32", PlyType::Uint32, 4},
    {"float", "float32", PlyType::Float32, 4},
    {"double", "float64", PlyType::Float64, 8},
}};

PlyType typeOf(std::string_view word) {
    for (const TypeName& type : kTypes)
        if (word == type.name || word == type.otherName) return type.type;
    throw Error("its header has the unknown type '{}'", word.substr(0, 40));
}

std::string_view takeLine(std::string_view& text) {
    const size_t length = text.find('\n');
    if (length == std::string_view::npos) throw Error("its header has no end_header");
    std::string_view line = text.substr(0, length);
    text.remove_prefix(length + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.empty()) return words;
        const size_t length = std::min(line.find_first_of(" \t"), line.size());
        words.push_back(line.substr(0, length));
        line.remove_prefix(length);
    }
}

PlyFormat formatOf(std::string_view word) {
    if (word == "ascii") return PlyFormat::Ascii;
    if (word == "binary_little_endian") return PlyFormat::LittleEndian;
    if (word == "binary_big_endian") return PlyFormat::BigEndian;
    throw Error("its header has the unknown format '{}'", word.substr(0, 40));
}

PlyElement elementOf(const std::vector<std::string_view>& words) {
    PlyElement element;
    if (words.size() != 3) throw Error("its header has a line 'element' that is not 'element NAME COUNT'");
    element.name = words[1];
    const auto [end, code] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (code != std::errc() || end != words[2].data() + words[2].size())
        throw Error("its header has '{}' for the number of elements '{}'", words[2].substr(0, 40), element.name);
    return element;
}

PlyProperty propertyOf(const std::vector<std::string_view>& words) {
    PlyProperty property;
    property.isList = words.size() == 5 && words[1] == "list";
    if (!property.isList && words.size() != 3) throw Error("its header has a property that is not 'TYPE NAME'");
    property.name = words.back();
    property.type = typeOf(words[words.size() - 2]);
    if (property.isList) property.countType = typeOf(words[2]);
    return property;
}

}  // namespace

uint32_t sizeOf(PlyType type) {
    return kTypes[size_t(type)].bytes;
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (size_t i = 0; i < properties.size(); ++i)
        if (std::ranges::find(names, properties[i].name) != names.end()) return int(i);
    return -1;
}

PlyHeader takePlyHeader(std::string_view& text) {
    if (takeLine(text) != "ply") throw Error("it is no PLY file");
    PlyHeader header;
    std::optional<PlyFormat> format;
    size_t count = 0;
    while (true) {
        const std::vector<std::string_view> words = wordsOf(takeLine(text));
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") break;
        if (++count > kMaxWords) throw Error("its header has more than {} lines", kMaxWords);
        if (words[0] == "format" && words.size() >= 2)
            format = formatOf(words[1]);
        else if (words[0] == "element")
            header.elements.push_back(elementOf(words));
        else if (words[0] == "property" && !header.elements.empty())
            header.elements.back().properties.push_back(propertyOf(words));
        else
            throw Error("its header has the unknown line '{}'", words[0].substr(0, 40));
    }
    if (!format) throw Error("its header has no format");
    header.format = *format;
    return header;
}

}  // namespace voxray

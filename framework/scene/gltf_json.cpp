#include "scene/gltf_json.h"

#include <cmath>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/one_line.h"

namespace voxray {
namespace {

using nlohmann::json;

constexpr int maxDepth = 64;

uint32_t readU32(std::span<const uint8_t> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value |= uint32_t(bytes[offset + i]) << (8 * i);
    return value;
}

struct Chunks {
    std::span<const uint8_t> json, bin;
};

/// The first two chunks of a .glb file, with checked lengths. Other types of chunks belong to extensions
/// (glTF 2.0, section 4.4.3.1).
Chunks chunksOf(std::span<const uint8_t> file) {
    constexpr uint32_t jsonType = 0x4E4F534A;
    constexpr uint32_t binType = 0x004E4942;
    if (file.size() < 20) throw Error("the .glb header is cut off after {} bytes", file.size());
    if (const uint32_t version = readU32(file, 4); version != 2)
        throw Error(".glb version {} is not supported; convert it to glTF 2.0", version);
    const uint64_t length = readU32(file, 8);
    if (length > file.size())
        throw Error("truncated: the header promises {} bytes, the file has {}", length, file.size());
    Chunks chunks;
    uint64_t offset = 12;
    for (size_t chunk = 0; offset + 8 <= length; ++chunk) {
        const uint64_t bytes = readU32(file, offset);
        const uint32_t type = readU32(file, offset + 4);
        offset += 8;
        if (bytes > length - offset) throw Error("truncated: chunk {} ends outside of the file", chunk);
        if (chunk == 0 && type != jsonType) throw Error("its first chunk is not JSON");
        const auto content = file.subspan(size_t(offset), size_t(bytes));
        if (chunk == 0) chunks.json = content;
        if (chunk == 1 && type == binType) chunks.bin = content;
        offset += bytes;
    }
    return chunks;
}

/// Limits nesting: the parser recurses, and a file of brackets would overflow the stack.
void checkDepth(std::string_view text) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            inString = c != '"';
        } else if (c == '"') {
            inString = true;
        } else if (c == '[' || c == '{') {
            if (++depth > maxDepth) throw Error("its JSON is nested more than {} levels deep", maxDepth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

/// Replaces invalid UTF-8, which old exporters leave in names, by U+FFFD.
std::string withValidUtf8(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const size_t length = utf8Length(text);
        out += length > 0 ? text.substr(0, length) : "\xef\xbf\xbd";
        text.remove_prefix(std::max(length, size_t(1)));
    }
    return out;
}

/// Converts whole numbers such as 3.0 to integers: JSON has one type of number.
void makeIntegers(json& value) {
    constexpr double largest = 9007199254740992.0;  // 2^53: above, doubles skip integers
    if (value.is_structured()) {
        for (json& member : value) makeIntegers(member);
    } else if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::abs(number) < largest)
            value = number >= 0 ? json(uint64_t(number)) : json(int64_t(number));
    }
}

json parse(std::string_view text) {
    // Some exporters pad with zeros.
    while (text.ends_with('\0')) text.remove_suffix(1);
    if (text.empty()) throw Error("it is empty");
    const std::string_view first = text.substr(std::min(text.find_first_not_of("\xEF\xBB\xBF \t\r\n"), text.size()));
    if (!first.starts_with('{') && !first.starts_with('['))
        throw Error("it is no glTF: it begins neither with 'glTF', as .glb files do, nor with '{{', as JSON does");
    checkDepth(text);
    try {
        json root = json::parse(withValidUtf8(text));
        makeIntegers(root);
        return root;
    } catch (const json::exception& error) {
        // Without the name of the exception, which precedes the message in brackets
        const std::string_view what = error.what();
        throw Error("its JSON is broken: {}", what.substr(what.find(' ') + 1));
    }
}

}  // namespace

GltfContainer openGltf(std::span<const uint8_t> file) {
    GltfContainer container;
    container.binary = file.size() >= 4 && std::memcmp(file.data(), "glTF", 4) == 0;
    const Chunks chunks = container.binary ? chunksOf(file) : Chunks{file, {}};
    container.root = parse({reinterpret_cast<const char*>(chunks.json.data()), chunks.json.size()});
    if (!container.root.is_object()) throw Error("its JSON is not an object, so it is not glTF");
    container.bin = chunks.bin;
    return container;
}

const json& objects(const json& object, const char* key) {
    static const json none = json::array();
    const auto entry = object.find(key);
    if (entry == object.end()) return none;
    if (!entry->is_array()) throw Error("'{}' is not an array", key);
    for (const json& item : *entry)
        if (!item.is_object()) throw Error("'{}' has an entry that is not an object", key);
    return *entry;
}

uint64_t unsignedMember(const json& object, const char* key, const std::string& what, int64_t fallback) {
    const auto entry = object.find(key);
    if (entry == object.end() && fallback >= 0) return uint64_t(fallback);
    if (entry == object.end() || !entry->is_number_unsigned())
        throw Error("{} needs '{}' as a non-negative integer", what, key);
    return entry->get<uint64_t>();
}

const json* extensionOf(const json& object, const char* extension) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return nullptr;
    const auto entry = extensions->find(extension);
    return entry == extensions->end() || !entry->is_object() ? nullptr : &*entry;
}

}  // namespace voxray

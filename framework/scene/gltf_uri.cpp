#include "scene/gltf_uri.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/error.h"
#include "base/files.h"

namespace voxray {
namespace {

namespace fs = std::filesystem;

bool isHex(char c) {
    return std::isxdigit(static_cast<unsigned char>(c)) != 0;
}

/// Decodes percent codes; a plus is no space, which it is in forms alone.
std::string percentDecoded(std::string_view text) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && isHex(text[i + 1]) && isHex(text[i + 2])) {
            out += char(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

/// Value of a base64 or base64url character; -1 if invalid (RFC 4648).
int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

std::vector<uint8_t> base64Decoded(std::string_view text) {
    std::vector<uint8_t> out;
    out.reserve(text.size() / 4 * 3 + 3);
    uint32_t bits = 0;
    int bitCount = 0;
    for (const char c : text) {
        if (c == '=') break;
        if (std::isspace(static_cast<unsigned char>(c))) continue;
        const int digit = base64Digit(c);
        if (digit < 0) throw Error("its data URI has a character that is not of base64");
        bits = bits << 6 | uint32_t(digit);
        bitCount += 6;
        if (bitCount < 8) continue;
        bitCount -= 8;
        out.push_back(uint8_t(bits >> bitCount));
    }
    return out;
}

std::vector<uint8_t> dataUriBytes(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw Error("its data URI has no comma, so no data");
    const std::string content = percentDecoded(uri.substr(comma + 1));
    if (uri.substr(0, comma).ends_with(";base64")) return base64Decoded(content);
    return {content.begin(), content.end()};
}

/// Whether a path leaves the folder that it starts from.
bool leavesFolder(const std::string& name) {
    const fs::path path = fs::path(name).lexically_normal();
    const bool scheme = name.find(':') < name.find('/');
    return scheme || name.find('\0') != std::string::npos || path.is_absolute() ||
           (!path.empty() && *path.begin() == "..");
}

}  // namespace

bool isDataUri(const std::string& uri) {
    return uri.starts_with("data:");
}

fs::path findUri(const std::string& uri, const fs::path& folder) {
    fs::path found;
    for (std::string name : {percentDecoded(uri), uri})
        for (const bool backslashes : {true, false}) {
            if (!backslashes) std::replace(name.begin(), name.end(), '\\', '/');
            if (name.empty() || leavesFolder(name)) throw Error("uri '{}' is not a file below the scene's folder", uri);
            std::error_code ignored;
            const fs::path path = folder / fs::path(name).lexically_normal();
            if (found.empty() && fs::is_regular_file(path, ignored)) found = path;
        }
    return found;
}

std::vector<uint8_t> readUri(const std::string& uri, const fs::path& folder) {
    if (isDataUri(uri)) return dataUriBytes(uri);
    const fs::path path = findUri(uri, folder);
    if (path.empty()) throw Error("file '{}' is missing", uri);
    return readFile(path);
}

}  // namespace voxray

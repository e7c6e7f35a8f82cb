#include "scene/import/obj.h"

#include <array>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "scene/import/numbers.h"

namespace voxray {
namespace {

constexpr uint32_t kNoEntry = std::numeric_limits<uint32_t>::max();
constexpr size_t kLinesPerCheck = 65536;

/// Entries of a corner in the three lists; kNoEntry: it has none.
using Corner = std::array<uint32_t, 3>;

struct CornerHash {
    size_t operator()(const Corner& c) const {
        uint64_t hash = 0;
        for (const uint32_t number : c) hash = (hash ^ number) * 0x9E3779B97F4A7C15u;
        return size_t(hash ^ (hash >> 32));
    }
};

std::string_view takeToken(std::string_view& text) {
    constexpr std::string_view blank = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(blank), text.size()));
    const size_t length = std::min(text.find_first_of(blank), text.size());
    const std::string_view token = text.substr(0, length);
    text.remove_prefix(length);
    return token;
}

class ObjReader {
 public:
    ObjReader(const std::filesystem::path& path, MemoryBudget& memory) : name_(path.string()), memory_(memory) {}

    Mesh read(std::string_view text) {
        while (!text.empty()) {
            const size_t length = std::min(text.find('\n'), text.size());
            if (++line_ % kLinesPerCheck == 0 && interruptRequested()) throw Interrupted();
            readLine(text.substr(0, length));
            text.remove_prefix(std::min(length + 1, text.size()));
        }
        if (!allHaveNormals_) mesh_.normals.clear();
        if (!allHaveTexCoords_) mesh_.texCoords0.clear();
        return std::move(mesh_);
    }

 private:
    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
        throw Error(TextLocation{name_, int(std::min<size_t>(line_, 1u << 30))}, "{}",
                    fmt::format(text, std::forward<Args>(args)...));
    }

    template <typename Vector>
    void readVector(std::string_view text, std::vector<Vector>& list) {
        Vector v(0);
        for (int c = 0; c < int(Vector::length()); ++c) {
            const std::string_view token = takeToken(text);
            std::string_view rest = token;
            const auto number = takeNumber(rest);
            if (!number || !rest.empty()) fail("'{}' is no number", token.substr(0, 40));
            v[c] = float(*number);
        }
        memory_.reserve(1, sizeof(Vector));
        list.push_back(v);
    }

    void readLine(std::string_view line) {
        const std::string_view key = takeToken(line);
        if (key == "v") readVector(line, positions_);
        if (key == "vn") readVector(line, normals_);
        if (key == "vt") readVector(line, texCoords_);
        if (key == "f") readFace(line);
    }

    /// A number from 1 on, or from -1 down for the last entries.
    uint32_t entry(std::string_view text, size_t count) const {
        int64_t number = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (code != std::errc() || end != text.data() + text.size() || number == 0)
            fail("'{}' is no number of a vertex", text.substr(0, 40));
        const int64_t at = number > 0 ? number - 1 : int64_t(count) + number;
        if (at < 0 || at >= int64_t(count)) fail("vertex {} of {}", number, count);
        return uint32_t(at);
    }

    /// "p", "p/t", "p//n" or "p/t/n".
    Corner corner(std::string_view token) const {
        const size_t counts[] = {positions_.size(), texCoords_.size(), normals_.size()};
        Corner corner{kNoEntry, kNoEntry, kNoEntry};
        for (size_t i = 0; i < 3; ++i) {
            const size_t length = std::min(token.find('/'), token.size());
            if (length > 0 || i == 0) corner[i] = entry(token.substr(0, length), counts[i]);
            if (length == token.size()) break;
            token.remove_prefix(length + 1);
        }
        return corner;
    }

    uint32_t vertex(const Corner& corner) {
        const auto [known, isNew] = vertices_.try_emplace(corner, uint32_t(mesh_.positions.size()));
        if (!isNew) return known->second;
        if (mesh_.positions.size() >= kNoEntry) fail("more vertices than 32 bits can number");
        memory_.reserve(1, sizeof(glm::vec3) * 2 + sizeof(glm::vec2) + 4 * sizeof(Corner));
        mesh_.positions.push_back(positions_[corner[0]]);
        allHaveTexCoords_ = allHaveTexCoords_ && corner[1] != kNoEntry;
        allHaveNormals_ = allHaveNormals_ && corner[2] != kNoEntry;
        if (allHaveTexCoords_) mesh_.texCoords0.push_back(texCoords_[corner[1]]);
        if (allHaveNormals_) mesh_.normals.push_back(normals_[corner[2]]);
        return known->second;
    }

    void readFace(std::string_view line) {
        uint32_t first = 0, last = 0;
        for (size_t i = 0;; ++i) {
            const std::string_view token = takeToken(line);
            if (token.empty() || token.front() == '#') break;
            const uint32_t next = vertex(corner(token));
            if (i == 0) first = next;
            if (i >= 2) {
                memory_.reserve(1, sizeof(glm::uvec3));
                mesh_.triangles.push_back({first, last, next});
            }
            last = next;
        }
    }

    std::string name_;
    MemoryBudget& memory_;
    size_t line_ = 0;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<glm::vec2> texCoords_;
    std::unordered_map<Corner, uint32_t, CornerHash> vertices_;
    bool allHaveNormals_ = true, allHaveTexCoords_ = true;
    Mesh mesh_;
};

}  // namespace

Mesh readObj(const std::filesystem::path& path, MemoryBudget& memory) {
    const std::string text = readTextFile(path);
    memory.reserve(text.size(), 1);
    return ObjReader(path, memory).read(text);
}

}  // namespace voxray

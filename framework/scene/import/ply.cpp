#include "scene/import/ply.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/files.h"
#include "scene/import/inflate.h"
#include "scene/import/numbers.h"
#include "scene/import/ply_header.h"

namespace voxray {
namespace {

/// Takes one value after another from the bytes behind the header.
class PlyValues {
 public:
    PlyValues(std::string_view bytes, PlyFormat format) : bytes_(bytes), format_(format) {}

    double next(PlyType type) {
        if (format_ == PlyFormat::Ascii) return nextText();
        switch (type) {
            case PlyType::Int8:
                return binary<int8_t>();
            case PlyType::Uint8:
                return binary<uint8_t>();
            case PlyType::Int16:
                return binary<int16_t>();
            case PlyType::Uint16:
                return binary<uint16_t>();
            case PlyType::Int32:
                return binary<int32_t>();
            case PlyType::Uint32:
                return binary<uint32_t>();
            case PlyType::Float32:
                return double(binary<float>());
            case PlyType::Float64:
                return binary<double>();
        }
        return 0;
    }

    /// How many values of a type may follow at most.
    uint64_t room(PlyType type) const {
        // In text a digit and a space, the last one without a space
        return format_ == PlyFormat::Ascii ? (bytes_.size() + 1) / 2 : bytes_.size() / sizeOf(type);
    }

 private:
    double nextText() {
        bytes_.remove_prefix(std::min(bytes_.find_first_not_of(" \t\r\n"), bytes_.size()));
        if (bytes_.empty()) throw Error("it is truncated");
        const std::string_view rest = bytes_;
        const std::optional<double> number = takeNumber(bytes_);
        if (!number || (!bytes_.empty() && std::string_view(" \t\r\n").find(bytes_.front()) == std::string_view::npos))
            throw Error("'{}' is no number", rest.substr(0, std::min<size_t>(rest.find_first_of(" \t\r\n"), 40)));
        return *number;
    }

    template <typename T>
    T binary() {
        if (bytes_.size() < sizeof(T)) throw Error("it is truncated");
        std::array<char, sizeof(T)> bytes;
        for (size_t i = 0; i < sizeof(T); ++i)
            bytes[i] = bytes_[format_ == PlyFormat::BigEndian ? sizeof(T) - 1 - i : i];
        bytes_.remove_prefix(sizeof(T));
        return std::bit_cast<T>(bytes);
    }

    std::string_view bytes_;
    PlyFormat format_;
};

/// Number of values of a list, which the file has room for.
uint64_t takeLength(PlyValues& values, const PlyProperty& list) {
    const double length = values.next(list.countType);
    if (!(length >= 0 && length <= double(values.room(list.type))))
        throw Error("it is truncated: a list '{}' has {} values", list.name, length);
    return uint64_t(length);
}

void skip(PlyValues& values, const PlyProperty& property) {
    uint64_t count = property.isList ? takeLength(values, property) : 1;
    while (count-- > 0) values.next(property.type);
}

/// Checks an element's count before its memory is allocated.
void checkRoom(const PlyElement& element, const PlyValues& values) {
    if (element.count == 0) return;
    if (element.properties.empty()) throw Error("its elements '{}' have no properties", element.name);
    const PlyProperty& first = element.properties.front();
    if (element.count > values.room(first.isList ? first.countType : first.type))
        throw Error("it is truncated: it has no room for {} elements '{}'", element.count, element.name);
}

/// Integers are shares of their type's largest value.
float colorUnit(PlyType type) {
    switch (type) {
        case PlyType::Uint8:
            return std::numeric_limits<uint8_t>::max();
        case PlyType::Uint16:
            return std::numeric_limits<uint16_t>::max();
        case PlyType::Uint32:
            return float(std::numeric_limits<uint32_t>::max());
        default:
            return 1;
    }
}

/// Which properties of a vertex are what; -1: none.
struct VertexLayout {
    std::array<int, 3> position, normal, color;
    std::array<int, 2> texCoord;

    explicit VertexLayout(const PlyElement& e)
        : position{e.find({"x"}), e.find({"y"}), e.find({"z"})},
          normal{e.find({"nx"}), e.find({"ny"}), e.find({"nz"})},
          color{e.find({"r", "red", "color_0"}), e.find({"g", "green", "color_1"}), e.find({"b", "blue", "color_2"})},
          texCoord{e.find({"u", "s", "texture_u", "texture_s"}), e.find({"v", "t", "texture_v", "texture_t"})} {}
};

template <size_t n>
bool isComplete(const std::array<int, n>& properties, const PlyElement& element) {
    for (const int i : properties)
        if (i < 0 || element.properties[size_t(i)].isList) return false;
    return true;
}

void readVertices(const PlyElement& element, PlyValues& values, MemoryBudget& memory, Mesh& mesh) {
    const VertexLayout layout(element);
    if (!isComplete(layout.position, element)) throw Error("its vertices have no x, y and z");
    const bool hasNormals = isComplete(layout.normal, element), hasColors = isComplete(layout.color, element),
               hasTexCoords = isComplete(layout.texCoord, element);
    memory.reserve(element.count, sizeof(glm::vec3) * 2 + sizeof(glm::vec2) + sizeof(glm::vec4));
    mesh.positions.resize(element.count);
    if (hasNormals) mesh.normals.resize(element.count);
    if (hasTexCoords) mesh.texCoords0.resize(element.count);
    if (hasColors) mesh.colors.resize(element.count, glm::vec4(1));

    std::vector<float> row(element.properties.size());
    for (uint64_t v = 0; v < element.count; ++v) {
        for (size_t p = 0; p < row.size(); ++p) {
            if (element.properties[p].isList)
                skip(values, element.properties[p]);
            else
                row[p] = float(values.next(element.properties[p].type));
        }
        for (int i = 0; i < 3; ++i) {
            mesh.positions[v][i] = row[size_t(layout.position[size_t(i)])];
            if (hasNormals) mesh.normals[v][i] = row[size_t(layout.normal[size_t(i)])];
            if (hasTexCoords && i < 2) mesh.texCoords0[v][i] = row[size_t(layout.texCoord[size_t(i)])];
            if (hasColors) {
                const size_t p = size_t(layout.color[size_t(i)]);
                mesh.colors[v][i] = row[p] / colorUnit(element.properties[p].type);
            }
        }
    }
}

/// A face as a fan about its first corner.
void readFace(const PlyProperty& list, PlyValues& values, uint64_t vertexCount, std::vector<glm::uvec3>& triangles) {
    const uint64_t length = takeLength(values, list);
    glm::uvec3 corners(0);
    for (uint64_t i = 0; i < length; ++i) {
        const double index = values.next(list.type);
        if (!(index >= 0 && index < double(vertexCount)))
            throw Error("a face names vertex {}, but it has {} of them", index, vertexCount);
        if (i == 0) corners.x = uint32_t(index);
        corners = {corners.x, corners.z, uint32_t(index)};
        if (i >= 2) triangles.push_back(corners);
    }
}

void readFaces(const PlyElement& element, PlyValues& values, MemoryBudget& memory, Mesh& mesh) {
    constexpr size_t kStep = 1 << 16;
    const int indices = element.find({"vertex_indices", "vertex_index"});
    if (indices < 0 || !element.properties[size_t(indices)].isList) throw Error("its faces have no vertex_indices");
    size_t reserved = 0;
    for (uint64_t f = 0; f < element.count; ++f) {
        for (size_t p = 0; p < element.properties.size(); ++p) {
            if (p == size_t(indices))
                readFace(element.properties[p], values, mesh.positions.size(), mesh.triangles);
            else
                skip(values, element.properties[p]);
        }
        for (; mesh.triangles.size() >= reserved; reserved += kStep) memory.reserve(kStep, sizeof(glm::uvec3));
    }
}

Mesh readMesh(std::string_view bytes, MemoryBudget& memory) {
    const PlyHeader header = takePlyHeader(bytes);
    PlyValues values(bytes, header.format);
    Mesh mesh;
    bool hasVertices = false;
    for (const PlyElement& element : header.elements) {
        checkRoom(element, values);
        if (element.name == "vertex" && !hasVertices) {
            if (element.count > std::numeric_limits<uint32_t>::max()) throw Error("it has too many vertices");
            readVertices(element, values, memory, mesh);
            hasVertices = true;
        } else if (element.name == "face") {
            readFaces(element, values, memory, mesh);
        } else {
            for (uint64_t i = 0; i < element.count; ++i)
                for (const PlyProperty& property : element.properties) skip(values, property);
        }
    }
    if (!hasVertices) throw Error("it has no vertices");
    return mesh;
}

}  // namespace

Mesh readPly(const std::filesystem::path& path, MemoryBudget& memory) {
    std::vector<uint8_t> bytes = readFile(path);
    try {
        if (isGzip(bytes)) bytes = inflateBytes(bytes, memory);
        return readMesh({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, memory);
    } catch (const Error& error) {
        throw Error("{}: {}", path.string(), error.what());
    }
}

}  // namespace voxray

#include "scene/mitsuba/serialized.h"

#include <bit>
#include <cstring>
#include <span>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "scene/import/inflate.h"

namespace voxray::mitsuba {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr uint16_t kFormat = 0x041C;
constexpr uint32_t kHasNormals = 0x0001, kHasTexCoords = 0x0002, kHasColors = 0x0008, kFaceNormals = 0x0010,
                   kDouble = 0x2000;
constexpr size_t kMaxName = 200;

/// Values one after another.
class Cursor {
 public:
    Cursor(std::span<const uint8_t> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

    /// The next `count` values of this size.
    std::span<const uint8_t> take(uint64_t count, size_t size) {
        if (count > bytes_.size() / size) throw Error("{}: is broken or truncated: its data end too early", name_);
        const std::span<const uint8_t> taken = bytes_.first(size_t(count) * size);
        bytes_ = bytes_.subspan(taken.size());
        return taken;
    }
    template <typename T>
    T take() {
        T value;
        std::memcpy(&value, take(1, sizeof value).data(), sizeof value);
        return value;
    }

 private:
    std::span<const uint8_t> bytes_;
    std::string name_;
};

template <typename T>
T valueAt(std::span<const uint8_t> bytes, uint64_t offset, const std::string& name) {
    T value;
    if (offset > bytes.size() || bytes.size() - offset < sizeof value) throw Error("{}: is truncated", name);
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

uint16_t versionAt(std::span<const uint8_t> bytes, uint64_t offset, const std::string& name) {
    const auto format = valueAt<uint16_t>(bytes, offset, name);
    const auto version = valueAt<uint16_t>(bytes, offset + 2, name);
    if (format != kFormat || (version != 3 && version != 4))
        throw Error("{}: is no serialized mesh of version 3 or 4", name);
    return version;
}

/// Vectors of floats or doubles.
template <typename Vector>
std::vector<Vector> takeVectors(Cursor& in, uint64_t count, bool isDouble, MemoryBudget& memory) {
    constexpr auto each = size_t(Vector::length());
    const std::span<const uint8_t> bytes = in.take(count, each * (isDouble ? sizeof(double) : sizeof(float)));
    memory.reserve(count, sizeof(Vector));
    std::vector<Vector> vectors(size_t(count), Vector(0));
    if (!isDouble) {
        if (count > 0) std::memcpy(vectors.data(), bytes.data(), bytes.size());
        return vectors;
    }
    for (size_t i = 0; i < vectors.size() * each; ++i) {
        double value;
        std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
        vectors[i / each][int(i % each)] = float(value);
    }
    return vectors;
}

/// The content of the mesh that begins here.
std::vector<uint8_t> inflatedMesh(std::span<const uint8_t> bytes, const std::string& name, MemoryBudget& memory) {
    try {
        return inflateBytes(bytes, memory);
    } catch (const Interrupted&) {
        throw;
    } catch (const Error& error) {
        throw Error("{}: {}", name, error.what());
    }
}

}  // namespace

Mesh readSerialized(const std::filesystem::path& path, uint64_t index, MemoryBudget& memory) {
    const std::string name = path.string();
    const std::vector<uint8_t> file = readFile(path);
    memory.reserve(file.size(), 1);
    const std::span<const uint8_t> bytes(file);
    // The end holds the places of all meshes, and their number
    const uint16_t version = versionAt(bytes, 0, name);
    const uint64_t entry = version == 4 ? sizeof(uint64_t) : sizeof(uint32_t);
    const uint64_t count = valueAt<uint32_t>(bytes, bytes.size() - 4, name);
    if (index >= count) throw Error("{}: has {} meshes, so no mesh {}", name, count, index);
    if (count > (bytes.size() - 4) / entry) throw Error("{}: is truncated", name);
    const uint64_t at = bytes.size() - 4 - (count - index) * entry;
    const uint64_t offset = version == 4 ? valueAt<uint64_t>(bytes, at, name) : valueAt<uint32_t>(bytes, at, name);
    versionAt(bytes, offset, name);

    const std::vector<uint8_t> content = inflatedMesh(bytes.subspan(size_t(offset) + 4), name, memory);
    Cursor in(content, name);
    const auto flags = in.take<uint32_t>();
    Mesh mesh;
    for (char c = 1; version == 4 && c != 0;)
        if ((c = in.take<char>()) != 0 && mesh.name.size() < kMaxName) mesh.name += c;
    const auto vertices = in.take<uint64_t>(), triangles = in.take<uint64_t>();
    if (vertices >= uint64_t(1) << 31 || triangles >= uint64_t(1) << 31)
        throw Error("{}: mesh {} has more than 2^31 vertices or triangles", name, index);
    const bool isDouble = (flags & kDouble) != 0;
    mesh.positions = takeVectors<glm::vec3>(in, vertices, isDouble, memory);
    if (flags & kHasNormals) mesh.normals = takeVectors<glm::vec3>(in, vertices, isDouble, memory);
    if (flags & kHasTexCoords) mesh.texCoords0 = takeVectors<glm::vec2>(in, vertices, isDouble, memory);
    if (flags & kHasColors)
        for (const glm::vec3& color : takeVectors<glm::vec3>(in, vertices, isDouble, memory))
            mesh.colors.emplace_back(color, 1);
    if (flags & kFaceNormals) mesh.normals.clear();
    const std::span<const uint8_t> indices = in.take(triangles, sizeof(glm::uvec3));
    memory.reserve(triangles, sizeof(glm::uvec3));
    mesh.triangles.resize(size_t(triangles));
    if (triangles > 0) std::memcpy(mesh.triangles.data(), indices.data(), indices.size());
    return mesh;
}

}  // namespace voxray::mitsuba

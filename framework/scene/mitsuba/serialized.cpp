#include "scene/mitsuba/serialized.h"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <memory>
#include <span>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"

namespace voxray::mitsuba {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr uint16_t kFormat = 0x041C;
constexpr uint32_t kHasNormals = 0x0001, kHasTexCoords = 0x0002, kHasColors = 0x0008, kFaceNormals = 0x0010,
                   kDouble = 0x2000;
constexpr size_t kMaxName = 65536;
/// Values are decompressed in blocks, so that memory follows what the file really holds.
constexpr size_t kBlockBytes = 1 << 20;

/// Bytes that a zlib stream holds, one after another.
class Inflater {
 public:
    Inflater(std::span<const uint8_t> compressed, std::string name) : name_(std::move(name)) {
        stream_.next_in = const_cast<uint8_t*>(compressed.data());
        stream_.avail_in = uInt(std::min<size_t>(compressed.size(), std::numeric_limits<uInt>::max()));
        if (inflateInit(&stream_) != Z_OK) throw Error("zlib can't be started: too little memory");
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void read(void* data, size_t bytes) {
        stream_.next_out = static_cast<uint8_t*>(data);
        stream_.avail_out = uInt(bytes);
        while (stream_.avail_out > 0) {
            const int code = inflate(&stream_, Z_SYNC_FLUSH);
            if (code == Z_OK || (code == Z_STREAM_END && stream_.avail_out == 0)) continue;
            throw Error("{}: is broken or truncated: its data end {} bytes too early", name_, stream_.avail_out);
        }
    }
    template <typename T>
    T read() {
        T value;
        read(&value, sizeof value);
        return value;
    }

 private:
    z_stream stream_{};
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

/// Reads `count` vectors of floats or doubles.
template <typename Vector>
std::vector<Vector> readVectors(Inflater& in, uint64_t count, bool isDouble, MemoryBudget& memory) {
    const size_t size = isDouble ? sizeof(double) : sizeof(float);
    const size_t each = size_t(Vector::length());
    const uint64_t perBlock = kBlockBytes / (each * size);
    std::vector<uint8_t> block(size_t(std::min(count, perBlock)) * each * size);
    std::vector<Vector> vectors;
    for (uint64_t done = 0; done < count;) {
        if (interruptRequested()) throw Interrupted();
        const auto number = size_t(std::min(count - done, perBlock));
        in.read(block.data(), number * each * size);
        memory.reserve(number, sizeof(Vector));
        for (size_t i = 0; i < number; ++i) {
            Vector v;
            for (size_t c = 0; c < each; ++c) {
                float single;
                double precise;
                const uint8_t* at = block.data() + (i * each + c) * size;
                if (isDouble)
                    std::memcpy(&precise, at, sizeof precise);
                else
                    std::memcpy(&single, at, sizeof single);
                v[int(c)] = isDouble ? float(precise) : single;
            }
            vectors.push_back(v);
        }
        done += number;
    }
    return vectors;
}

std::vector<glm::uvec3> readTriangleList(Inflater& in, uint64_t count, MemoryBudget& memory) {
    constexpr uint64_t perBlock = kBlockBytes / sizeof(glm::uvec3);
    std::vector<glm::uvec3> triangles;
    while (triangles.size() < count) {
        const auto number = size_t(std::min<uint64_t>(count - triangles.size(), perBlock));
        memory.reserve(number, sizeof(glm::uvec3));
        triangles.resize(triangles.size() + number);
        in.read(triangles.data() + triangles.size() - number, number * sizeof(glm::uvec3));
    }
    return triangles;
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

    Inflater in(bytes.subspan(size_t(offset) + 4), name);
    const auto flags = in.read<uint32_t>();
    Mesh mesh;
    for (char c = 1; version == 4 && c != 0 && mesh.name.size() <= kMaxName;)
        if ((c = in.read<char>()) != 0) mesh.name += c;
    const auto vertices = in.read<uint64_t>(), triangles = in.read<uint64_t>();
    if (vertices >= uint64_t(1) << 31 || triangles >= uint64_t(1) << 31)
        throw Error("{}: mesh {} has more than 2^31 vertices or triangles", name, index);
    const bool isDouble = (flags & kDouble) != 0;
    mesh.positions = readVectors<glm::vec3>(in, vertices, isDouble, memory);
    if (flags & kHasNormals) mesh.normals = readVectors<glm::vec3>(in, vertices, isDouble, memory);
    if (flags & kHasTexCoords) mesh.texCoords0 = readVectors<glm::vec2>(in, vertices, isDouble, memory);
    if (flags & kHasColors)
        for (const glm::vec3& color : readVectors<glm::vec3>(in, vertices, isDouble, memory))
            mesh.colors.emplace_back(color, 1);
    if (flags & kFaceNormals) mesh.normals.clear();
    mesh.triangles = readTriangleList(in, triangles, memory);
    return mesh;
}

}  // namespace voxray::mitsuba

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>

#include "scene/import/inflate.h"
#include "scene/import/loop_subdivision.h"
#include "scene/import/ply.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

/// Readers of meshes that scenes of other renderers name.
namespace voxray::test {
namespace {

class PlyFiles : public testing::Test {
 protected:
    Mesh read(const std::string& bytes) {
        std::ofstream(folder_ / "a.ply", std::ios::binary) << bytes;
        MemoryBudget memory;
        return readPly(folder_ / "a.ply", memory);
    }
    TemporaryFolder folder_;
};

template <typename T>
void append(std::string& bytes, T value, bool bigEndian) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (bigEndian) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

/// A quad with all attributes and an element that nobody knows before its faces.
std::string binaryQuad(bool bigEndian) {
    std::string bytes = "ply\r\nformat ";
    bytes += bigEndian ? "binary_big_endian" : "binary_little_endian";
    bytes +=
        " 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
        "property uchar red\nproperty ushort green\nproperty float blue\n"
        "element other 2\nproperty list uint short some\nproperty char c\n"
        "element face 1\nproperty list uint8 int32 vertex_indices\nproperty float weight\nend_header\n";
    for (int i = 0; i < 4; ++i) {
        append(bytes, double(i % 2), bigEndian);
        for (const float value : {float(i / 2), 0.5f, 0.0f, 0.0f, 1.0f, 0.25f * float(i), 1.0f})
            append(bytes, value, bigEndian);
        append(bytes, uint8_t(255), bigEndian);
        append(bytes, uint16_t(13107), bigEndian);
        append(bytes, 0.75f, bigEndian);
    }
    for (uint32_t count : {0u, 2u}) {
        append(bytes, count, bigEndian);
        for (uint32_t i = 0; i < count; ++i) append(bytes, int16_t(-1), bigEndian);
        append(bytes, int8_t(7), bigEndian);
    }
    append(bytes, uint8_t(4), bigEndian);
    for (const int32_t index : {0, 1, 3, 2}) append(bytes, index, bigEndian);
    append(bytes, 1.0f, bigEndian);
    return bytes;
}

void expectQuad(const Mesh& mesh) {
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[3], glm::vec3(1, 1, 0.5f));
    ASSERT_EQ(mesh.normals.size(), 4u);
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
    ASSERT_EQ(mesh.texCoords0.size(), 4u);
    EXPECT_EQ(mesh.texCoords0[3], glm::vec2(0.75f, 1));
    ASSERT_EQ(mesh.colors.size(), 4u);
    EXPECT_EQ(mesh.colors[2], glm::vec4(1, 0.2f, 0.75f, 1));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 3));
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 3, 2));
}

TEST_F(PlyFiles, BinaryOfEitherByteOrder) {
    expectQuad(read(binaryQuad(false)));
    expectQuad(read(binaryQuad(true)));
}

TEST_F(PlyFiles, CompressedByGzip) {
    const std::string plain = binaryQuad(false);
    const std::string path = (folder_ / "a.ply.gz").string();
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, plain.data(), unsigned(plain.size()));
    gzclose(file);
    MemoryBudget memory;
    expectQuad(readPly(path, memory));

    std::string bytes;
    {
        std::ifstream in(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    EXPECT_ERROR("truncated", read(bytes.substr(0, bytes.size() / 2)));
    bytes[bytes.size() / 2] ^= 0x55;
    EXPECT_ERROR("compressed data is", read(bytes));
}

const std::string kTriangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_index\nend_header\n";

TEST_F(PlyFiles, Ascii) {
    const Mesh mesh = read(kTriangle + "0 0 0\n1e0 0 0\n+0.5 1 -2\n3 0 1 2\n");
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(0.5f, 1, -2));
    EXPECT_TRUE(mesh.normals.empty() && mesh.texCoords0.empty() && mesh.colors.empty());
    // The last number may end with the file
    EXPECT_EQ(read(kTriangle + "0 0 0 1 0 0 0 1 0 3 0 1 2").triangles.size(), 1u);
}

TEST_F(PlyFiles, FacesOfAnySizeAreFans) {
    const Mesh mesh = read(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 3\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0 1 0 0 2 1 0 1 2 0 0 1 0  5 0 1 2 3 4  2 0 1  0\n");
    ASSERT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.triangles[2], glm::uvec3(0, 3, 4));
}

TEST_F(PlyFiles, WhatIsWrongIsSaid) {
    EXPECT_ERROR("a.ply: it is no PLY file", read("plx\nend_header\n"));
    EXPECT_ERROR("no end_header", read("ply\nformat ascii 1.0"));
    EXPECT_ERROR("no format", read("ply\nend_header\n"));
    EXPECT_ERROR("unknown type 'half'", read("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n"));
    EXPECT_ERROR("no vertices", read("ply\nformat ascii 1.0\nend_header\n"));
    EXPECT_ERROR("no x, y and z", read("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"));
    EXPECT_ERROR("names vertex 3, but it has 3", read(kTriangle + "0 0 0 1 0 0 0 1 0 3 0 1 3"));
    EXPECT_ERROR("names vertex -1", read(kTriangle + "0 0 0 1 0 0 0 1 0 3 0 1 -1"));
    EXPECT_ERROR("truncated", read(kTriangle + "0 0 0 1 0 0 0 1 0 3 0 1"));
    EXPECT_ERROR("'nan' is no number", read(kTriangle + "0 nan 0 1 0 0 0 1 0 3 0 1 2"));
    EXPECT_ERROR("'1x' is no number", read(kTriangle + "0 1x 0 1 0 0 0 1 0 3 0 1 2"));
    // Nothing is allocated for a number in the header before the bytes are there
    EXPECT_ERROR("no room for 4000000000 elements 'vertex'",
                 read("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n0\n"));
    EXPECT_ERROR("have no properties", read("ply\nformat ascii 1.0\nelement vertex 9999999999\nend_header\n"));
}

TEST_F(PlyFiles, MutatedFilesLoadOrAreRefused) {
    std::mt19937 random(1);
    size_t refused = 0;
    for (const std::string& good : {binaryQuad(false), binaryQuad(true), kTriangle + "0 0 0 1 0 0 0 1 0 3 0 1 2\n"})
        for (int i = 0; i < 700; ++i) {
            std::string bad = good;
            for (uint32_t f = 0; f < 1 + random() % 3; ++f) bad[random() % bad.size()] ^= char(1 << random() % 8);
            if (i % 7 == 0) bad.resize(random() % bad.size());
            try {
                const Mesh mesh = read(bad);
                for (const glm::uvec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
            } catch (const Error&) {
                ++refused;
            }
        }
    EXPECT_GT(refused, 500u);
}

Mesh octahedron() {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

TEST(LoopSubdivision, AnOctahedronsVerticesReachTheirLimits) {
    // Of valence 4: (1 - 4 w) p + w (sum of neighbours, here 0), w = 1 / (4 + 3 / (8 β)) = 1/8 with β = 3/32
    MemoryBudget memory;
    for (const uint32_t levels : {0u, 1u, 3u}) {
        const Mesh mesh = loopSubdivided(octahedron(), levels, memory);
        EXPECT_EQ(mesh.triangles.size(), 8u << (2 * levels));
        EXPECT_EQ(mesh.positions.size(), 2 + (4u << (2 * levels)));
        EXPECT_NEAR(glm::length(mesh.positions[0] - glm::vec3(0.5f, 0, 0)), 0, 1e-6f) << levels;
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            EXPECT_NEAR(glm::length(mesh.normals[v]), 1, 1e-5f);
            EXPECT_GT(glm::dot(mesh.normals[v], mesh.positions[v]), 0.4f * glm::length(mesh.positions[v]));
        }
        EXPECT_NEAR(mesh.normals[0].x, 1, 1e-6f);
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0);
        }
    }
}

TEST(LoopSubdivision, APlaneStaysOneAndBordersAreCubicSplines) {
    // A fan of six triangles around the origin
    Mesh mesh;
    mesh.positions = {{0, 0, 0}};
    for (int i = 0; i < 6; ++i) {
        const float angle = float(i) * 1.0471976f;
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0});
        mesh.triangles.push_back({0, 1 + uint32_t(i), 1 + uint32_t(i + 1) % 6});
    }
    MemoryBudget memory;
    const Mesh fine = loopSubdivided(mesh, 2, memory);
    for (size_t v = 0; v < fine.positions.size(); ++v) {
        EXPECT_NEAR(fine.positions[v].z, 0, 1e-6f);
        EXPECT_NEAR(fine.normals[v].z, 1, 1e-5f) << v;
    }
    // (a + 4 b + c) / 6 is the limit of a cubic B-spline of control points a, b and c
    const glm::vec3 limit = (mesh.positions[6] + 4.0f * mesh.positions[1] + mesh.positions[2]) / 6.0f;
    const Mesh finest = loopSubdivided(mesh, 7, memory);
    EXPECT_NEAR(glm::length(finest.positions[1] - limit), 0, 1e-4f);
}

TEST(LoopSubdivision, AnyMeshIsTaken) {
    MemoryBudget memory;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
    // Three triangles at an edge, one of them turned, one flat, a vertex of none
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 3}, {2, 2, 1}};
    const Mesh fine = loopSubdivided(mesh, 3, memory);
    EXPECT_EQ(fine.triangles.size(), 192u);
    for (const glm::vec3& p : fine.positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    EXPECT_ERROR("levels", loopSubdivided(mesh, 13, memory));
    Mesh large;
    large.positions.assign(3000, glm::vec3(0));
    for (uint32_t i = 0; i < 1000; ++i) large.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    large.triangles.resize(500'000, {0, 1, 2});
    EXPECT_ERROR("memory", loopSubdivided(large, 12, memory));
}

}  // namespace
}  // namespace voxray::test

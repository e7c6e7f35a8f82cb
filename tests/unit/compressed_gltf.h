#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include "scene_gltf_builder.h"

/// Files with compressed meshes, made by the codecs' own encoders.
namespace voxray::test {

/// Corners of a grid of n x n squares over the unit square, with z = x * y, three for each triangle.
inline std::vector<glm::vec3> gridCorners(int n) {
    const auto point = [&](int x, int y) {
        const glm::vec2 p = glm::vec2(x, y) / float(n);
        return glm::vec3(p, p.x * p.y);
    };
    std::vector<glm::vec3> corners;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            corners.insert(corners.end(), {point(x, y), point(x + 1, y), point(x, y + 1), point(x + 1, y),
                                           point(x + 1, y + 1), point(x, y + 1)});
    return corners;
}

/// The grid as KHR_draco_mesh_compression. @param speed of the encoder: 10 is sequential, below edgebreaker
inline GltfBuilder dracoGrid(int n, int speed) {
    const std::vector<glm::vec3> corners = gridCorners(n);
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(int(corners.size() / 3));
    const int positions = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
        soup.SetAttributeValuesForFace(positions, draco::FaceIndex(uint32_t(i / 3)), &corners[i], &corners[i + 1],
                                       &corners[i + 2]);
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::Encoder encoder;
    encoder.SetSpeedOptions(speed, speed);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer out;
    if (!encoder.EncodeMeshToBuffer(*mesh, &out).ok()) throw Error("the encoder failed");

    GltfBuilder b;
    const int view = b.view(std::vector<char>(out.data(), out.data() + out.size()));
    const int position = b.add("accessors", {{"componentType", floatType}, {"type", "VEC3"}, {"count", 1}});
    const int indices = b.add("accessors", {{"componentType", ushortType}, {"type", "SCALAR"}, {"count", 3}});
    b.primitive(
        {{"indices", indices},
         {"attributes", {{"POSITION", position}}},
         {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
    b.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return b;
}

/// The grid as EXT_meshopt_compression, without a fallback.
inline GltfBuilder meshoptGrid(int n) {
    const std::vector<glm::vec3> corners = gridCorners(n);
    std::vector<uint32_t> numbers(corners.size());
    const size_t count =
        meshopt_generateVertexRemap(numbers.data(), nullptr, corners.size(), corners.data(), corners.size(), 12);
    std::vector<glm::vec3> vertices(count);
    for (size_t i = 0; i < corners.size(); ++i) vertices[numbers[i]] = corners[i];

    GltfBuilder b;
    std::vector<uint8_t> bytes(meshopt_encodeVertexBufferBound(count, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(), count, 12));
    std::vector<uint8_t> triangles(meshopt_encodeIndexBufferBound(numbers.size(), count));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), numbers.data(), numbers.size()));
    const auto compressed = [&](const std::vector<uint8_t>& data, size_t elements, size_t stride, const char* mode) {
        const int raw = b.view(data);
        json extension = b.root["bufferViews"][size_t(raw)];
        extension.update({{"byteStride", stride}, {"count", elements}, {"mode", mode}});
        return b.add("bufferViews", {{"buffer", 1},
                                     {"byteOffset", 0},
                                     {"byteLength", elements * stride},
                                     {"extensions", {{"EXT_meshopt_compression", extension}}}});
    };
    const int position = b.accessor(compressed(bytes, count, 12, "ATTRIBUTES"), count, "VEC3", floatType);
    const int indices =
        b.accessor(compressed(triangles, numbers.size(), 4, "TRIANGLES"), numbers.size(), "SCALAR", uintType);
    b.primitive({{"indices", indices}, {"attributes", {{"POSITION", position}}}});
    const json fallback = {{"EXT_meshopt_compression", {{"fallback", true}}}};
    b.root["buffers"] = {{{"byteLength", b.bytes.size()}}, {{"byteLength", 1 << 20}, {"extensions", fallback}}};
    b.root["extensionsRequired"] = {"EXT_meshopt_compression"};
    return b;
}

}  // namespace voxray::test

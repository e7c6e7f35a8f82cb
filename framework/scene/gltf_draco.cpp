#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <array>
#include <cstring>

#include "base/error.h"
#include "scene/gltf_compression.h"
#include "scene/gltf_json.h"

namespace voxray {
namespace {

using nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Maximum number of triangles or vertices per byte, against malicious files.
constexpr uint64_t maxPerByte = 1024;

/// Checks the counts in the stream's header against its size, since the decoder allocates by them.
void checkCounts(const std::vector<uint8_t>& bytes, const ReserveMemory& reserve) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) throw Error("it has no header");
    const int version = header.version_major * 256 + header.version_minor;
    if (version < 2 * 256 + 2 || header.encoder_type != draco::TRIANGULAR_MESH)
        throw Error("it is not a mesh of bitstream 2.2; compress it with a newer encoder");
    buffer.set_bitstream_version(uint16_t(version));
    draco::GeometryMetadata metadata;
    if ((header.flags & METADATA_FLAG_MASK) != 0 &&
        !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
        throw Error("its metadata is broken");

    // Edgebreaker: kind of traversal, vertices, triangles; sequential: triangles, vertices.
    uint8_t traversal = 0;
    std::array<uint32_t, 2> counts{};
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) buffer.Decode(&traversal);
    for (uint32_t& count : counts)
        if (!draco::DecodeVarint(&count, &buffer)) throw Error("it is cut off");
    for (const uint32_t count : counts) {
        if (count > maxPerByte * bytes.size())
            throw Error("{} triangles or vertices in {} bytes are too many", count, bytes.size());
        // Approximate bytes of corner table and attributes per triangle or vertex.
        reserve(count, 64);
    }
}

template <typename T>
std::vector<uint8_t> valuesOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
    const size_t components = attribute.num_components();
    std::vector<uint8_t> bytes(mesh.num_points() * components * sizeof(T));
    std::vector<T> element(components);
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(i), element.data()))
            throw Error("values of an attribute can't be converted");
        std::memcpy(&bytes[i.value() * components * sizeof(T)], element.data(), components * sizeof(T));
    }
    return bytes;
}

/// An attribute's values in the accessor's component type.
std::vector<uint8_t> attributeBytes(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                    uint64_t componentType) {
    switch (componentType) {
        case 5120:
            return valuesOf<int8_t>(mesh, attribute);
        case 5121:
            return valuesOf<uint8_t>(mesh, attribute);
        case 5122:
            return valuesOf<int16_t>(mesh, attribute);
        case 5123:
            return valuesOf<uint16_t>(mesh, attribute);
        case 5125:
            return valuesOf<uint32_t>(mesh, attribute);
        case 5126:
            return valuesOf<float>(mesh, attribute);
        default:
            throw Error("component type {} is not one of glTF's", componentType);
    }
}

/// Adds a buffer, its view and an accessor. @return the accessor's index
size_t addAccessor(json& root, GltfBuffers& buffers, std::vector<uint8_t> data, json accessor) {
    const json view = {{"buffer", buffers.size()}, {"byteOffset", 0}, {"byteLength", data.size()}};
    buffers.push_back(std::move(data));
    root["bufferViews"].push_back(view);
    accessor["bufferView"] = root["bufferViews"].size() - 1;
    accessor["byteOffset"] = 0;
    root["accessors"].push_back(std::move(accessor));
    return root["accessors"].size() - 1;
}

void expandPrimitive(json& root, json& primitive, GltfBuffers& buffers, const ReserveMemory& reserve) {
    const json source = *extensionOf(primitive, kDraco);
    const std::vector<uint8_t> bytes = viewBytes(root, buffers, unsignedMember(source, "bufferView", kDraco));
    checkCounts(bytes, reserve);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) throw Error("Draco says: {}", result.status().error_msg_string());
    const draco::Mesh& mesh = *result.value();
    if (mesh.num_points() == 0) throw Error("it has no vertices");

    // Triangles
    reserve(mesh.num_faces(), 3 * sizeof(uint32_t));
    std::vector<uint8_t> indices(mesh.num_faces() * 3 * sizeof(uint32_t));
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t index = mesh.face(f)[corner].value();
            std::memcpy(&indices[(f.value() * 3 + corner) * sizeof index], &index, sizeof index);
        }
    primitive["indices"] =
        addAccessor(root, buffers, std::move(indices),
                    {{"type", "SCALAR"}, {"componentType", 5125}, {"count", uint64_t(mesh.num_faces()) * 3}});
    primitive["mode"] = 4;

    // Attributes, in the types of their accessors
    const json attributes = source.value("attributes", json::object());
    if (!attributes.is_object() || !primitive["attributes"].is_object())
        throw Error("its attributes are not an object");
    for (const auto& [name, id] : attributes.items()) {
        const json& number = primitive["attributes"].value(name, json());
        const draco::PointAttribute* attribute =
            id.is_number_unsigned() ? mesh.GetAttributeByUniqueId(id.get<uint32_t>()) : nullptr;
        if (attribute == nullptr || !number.is_number_unsigned() ||
            number.get<uint64_t>() >= objects(root, "accessors").size())
            throw Error("{} is not in the compressed data, or has no accessor", name);
        json accessor = root["accessors"][number.get<size_t>()];
        constexpr std::array types{"SCALAR", "VEC2", "VEC3", "VEC4"};
        const size_t components = attribute->num_components();
        if (components < 1 || components > 4) throw Error("{} has {} components", name, components);
        reserve(mesh.num_points(), components * sizeof(float));
        accessor["type"] = types[components - 1];
        accessor["count"] = mesh.num_points();
        accessor.erase("sparse");
        primitive["attributes"][name] = addAccessor(
            root, buffers, attributeBytes(mesh, *attribute, unsignedMember(accessor, "componentType", name)), accessor);
    }
}

}  // namespace

void expandDraco(json& root, GltfBuffers& buffers, const ReserveMemory& reserve) {
    for (size_t m = 0; m < objects(root, "meshes").size(); ++m)
        for (size_t p = 0; p < objects(root["meshes"][m], "primitives").size(); ++p) {
            json& primitive = root["meshes"][m]["primitives"][p];
            if (extensionOf(primitive, kDraco) == nullptr) continue;
            try {
                expandPrimitive(root, primitive, buffers, reserve);
            } catch (const Error& error) {
                throw Error("mesh {}, primitive {}: {}: {}", m, p, kDraco, error.what());
            }
        }
}

}  // namespace voxray

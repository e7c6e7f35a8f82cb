#include "scene/gltf_mesh.h"

#include <cmath>
#include <numeric>

#include "scene/gltf_accessor.h"
#include "scene/gltf_skin.h"
#include "scene/mesh_repair.h"

namespace voxray {
namespace {

constexpr size_t maxVertices = size_t(1) << 31;
/// All attributes of a vertex that is copied or split.
constexpr size_t bytesPerVertex = 3 * sizeof(glm::vec4) + 3 * sizeof(glm::vec3);

/// Reads an attribute, if present. @throws Error if it differs in length from the positions.
template <typename Vector>
void readAttribute(GltfFile& file, const tinygltf::Primitive& primitive, const char* name, uint32_t minComponents,
                   uint32_t maxComponents, float fallback, std::vector<Vector>& out, size_t vertexCount,
                   const std::string& what) {
    const auto entry = primitive.attributes.find(name);
    if (entry == primitive.attributes.end()) return;
    const bool fractions = std::string_view(name) == "COLOR_0";
    const AccessorValues values = readAccessor(file, entry->second, minComponents, maxComponents, name, fractions);
    if (values.count != vertexCount)
        file.fail("{}: {} has {} elements for {} positions", what, name, values.count, vertexCount);
    file.reserve(values.count, sizeof(Vector));
    out.resize(values.count);
    for (size_t i = 0; i < values.count; ++i)
        for (int c = 0; c < int(Vector::length()); ++c) out[i][c] = values.get(i, uint32_t(c), fallback);
}

/// Replaces components that are not finite. @return number of vectors changed
template <typename Vector>
size_t replaceNonFinite(std::vector<Vector>& values, float replacement) {
    size_t count = 0;
    for (Vector& v : values) {
        bool finite = true;
        for (int c = 0; c < int(Vector::length()); ++c) {
            if (std::isfinite(v[c])) continue;
            v[c] = replacement;
            finite = false;
        }
        count += finite ? 0 : 1;
    }
    return count;
}

std::vector<glm::uvec3> trianglesOf(GltfFile& file, int mode, const std::vector<uint32_t>& indices,
                                    const std::string& what) {
    std::vector<glm::uvec3> triangles;
    const size_t count = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        if (count % 3 != 0) file.warn("{}: {} indices are not whole triangles; the rest is left out", what, count);
        triangles.reserve(count / 3);
        for (size_t i = 0; i + 2 < count; i += 3) triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (size_t i = 0; i + 2 < count; ++i)
            triangles.push_back({indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    } else {
        for (size_t i = 0; i + 2 < count; ++i) triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
    }
    return triangles;
}

void readTriangles(GltfFile& file, const tinygltf::Primitive& primitive, Mesh& mesh, const std::string& what) {
    // Without indices, vertices in order.
    std::vector<uint32_t> indices;
    if (primitive.indices >= 0) {
        indices = readIndices(file, primitive.indices);
    } else {
        file.reserve(mesh.positions.size(), sizeof(uint32_t));
        indices.resize(mesh.positions.size());
        std::iota(indices.begin(), indices.end(), 0u);
    }
    for (const uint32_t index : indices)
        if (index >= mesh.positions.size())
            file.fail("{}: index {} for {} vertices", what, index, mesh.positions.size());
    file.reserve(indices.size(), sizeof(glm::uvec3));
    mesh.triangles = trianglesOf(file, primitive.mode, indices, what);
}

/// Reads all attributes.
void readAttributes(GltfFile& file, const tinygltf::Primitive& primitive, const FixedWeights& weights, Mesh& mesh,
                    const std::string& what) {
    const size_t count = mesh.positions.size();
    readAttribute(file, primitive, "TEXCOORD_0", 2, 2, 0, mesh.texCoords0, count, what);
    readAttribute(file, primitive, "TEXCOORD_1", 2, 2, 0, mesh.texCoords1, count, what);
    readAttribute(file, primitive, "COLOR_0", 3, 4, 1, mesh.colors, count, what);
    readAttribute(file, primitive, "NORMAL", 3, 3, 0, mesh.normals, count, what);
    // Tangents are meaningless without normals (glTF 2.0, section 3.7.2.1).
    if (!mesh.normals.empty()) readAttribute(file, primitive, "TANGENT", 4, 4, 1, mesh.tangents, count, what);
    readMorphTargets(file, primitive, weights, mesh, what);
    readSkinWeights(file, primitive, mesh, what);
}

/// Computes missing or invalid normals and tangents.
void completeNormals(GltfFile& file, const Material& material, Mesh& mesh, const std::string& what) {
    bool make = mesh.tangents.empty();
    if (mesh.normals.empty()) {
        file.reserve(3 * mesh.triangles.size(), bytesPerVertex);
        makeFlatNormals(mesh);
    } else if (const size_t bad = repairNormals(mesh); bad > 0) {
        file.warn("{}: {} normals are not finite; taken from their triangles", what, bad);
    }
    if (!mesh.tangents.empty() && !normalizeTangents(mesh)) {
        file.warn("{}: TANGENT has values that are zero or not finite; computed instead", what);
        mesh.tangents.clear();
        make = true;
    }
    if (make && material.normalTexture.texture >= 0) {
        file.reserve(mesh.positions.size(), bytesPerVertex);
        makeTangents(mesh, material.normalTexture.texCoord);
        if (!mesh.morph.targets.empty()) mesh.morph.tangentTexCoords = material.normalTexture.texCoord;
    }
}

}  // namespace

Mesh readPrimitive(GltfFile& file, const tinygltf::Primitive& primitive, const FixedWeights& weights,
                   const Material& material, const std::string& what) {
    Mesh mesh;
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        file.fail("{}: mode {} is not one of glTF's", what, primitive.mode);
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        file.warn("{}: points and lines are left out", what);
        return mesh;
    }
    if (!primitive.attributes.contains("POSITION")) {
        file.warn("{}: it has no POSITION; left out", what);
        return mesh;
    }

    // Positions and triangles must be valid.
    const int positions = primitive.attributes.at("POSITION");
    const size_t count = file.at(file.model().accessors, positions, "accessor").count;
    if (count > maxVertices) file.fail("{}: more than 2^31 vertices", what);
    readAttribute(file, primitive, "POSITION", 3, 3, 0, mesh.positions, count, what);
    readTriangles(file, primitive, mesh, what);
    if (mesh.triangles.empty()) {
        file.warn("{}: it has no triangles; left out", what);
        return mesh;
    }
    readAttributes(file, primitive, weights, mesh, what);
    dropUnusedVertices(mesh);
    if (replaceNonFinite(mesh.positions, 0) > 0) file.fail("{}: it has positions that are not finite", what);

    // Texture coordinates and colours are repaired.
    if (replaceNonFinite(mesh.texCoords0, 0) + replaceNonFinite(mesh.texCoords1, 0) > 0)
        file.warn("{}: texture coordinates that are not finite are taken as 0", what);
    if (replaceNonFinite(mesh.colors, 1) > 0) file.warn("{}: colours that are not finite are taken as 1", what);
    if (const size_t others = limitColors(mesh, material); others > 0)
        file.warn("{}: COLOR_0 of {} vertices is limited, so that it is from 0 to 1 times baseColorFactor", what,
                  others);
    completeNormals(file, material, mesh, what);
    if (weights) applyMorphTargets(*weights, mesh);
    return mesh;
}

}  // namespace voxray

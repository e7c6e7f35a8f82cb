#include <limits>

#include "scene/mesh_repair.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();

TEST(MeshRepair, MissingNormalsAreFlatAndUnshared) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.texCoords0 = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 1}};
    makeFlatNormals(mesh);
    ASSERT_EQ(mesh.positions.size(), 9u);
    ASSERT_EQ(mesh.texCoords0.size(), 9u);
    expectNear(mesh.normals[0], {0, 0, 1}, 0);
    expectNear(mesh.normals[4], {1, 0, 0}, 0);
    expectNear(mesh.normals[8], {0, 1, 0}, 0);
    EXPECT_EQ(mesh.texCoords0[5], glm::vec2(1, 1));
}

TEST(MeshRepair, BadNormalsComeFromTriangles) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1e30f, 0, 0}, {0, 1e30f, 0}, {5, 5, 5}};
    mesh.normals = {{nan, 0, 0}, {0, 0, 0}, {0, 3, 4}, {0, 0, std::numeric_limits<float>::infinity()}};
    mesh.triangles = {{0, 1, 2}, {3, 3, 3}};
    EXPECT_EQ(repairNormals(mesh), 2u);
    expectNear(mesh.normals[0], {0, 0, 1}, 0);
    expectNear(mesh.normals[1], {0, 0, 1}, 0);
    expectNear(mesh.normals[2], {0, 0.6f, 0.8f}, 1e-6f);
    expectNear(mesh.normals[3], {0, 1, 0}, 0);
}

TEST(MeshRepair, TangentsFollowUAndMirroredHalvesAreSplit) {
    // Two quads side by side whose u runs outwards from the shared edge.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 1, 0}};
    mesh.normals.assign(6, {0, 0, 1});
    mesh.texCoords0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0}, {1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
    makeTangents(mesh, 0);
    ASSERT_EQ(mesh.positions.size(), 8u);
    for (size_t i = 0; i < 4; ++i)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec4 t = mesh.tangents[mesh.triangles[i][corner]];
            EXPECT_EQ(t, i < 2 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1)) << i;
            // The bitangent is the way v grows.
            expectNear(glm::cross(glm::vec3(0, 0, 1), glm::vec3(t)) * t.w, {0, 1, 0}, 1e-6f);
        }
}

TEST(MeshRepair, TangentsWithoutUsableCoordinatesAreStillUnitVectors) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 2}};
    mesh.normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 3, 3}};
    makeTangents(mesh, 1);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1, 1e-6);
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0, 1e-6);
    }
}

TEST(GltfMeshes, RepairsAreWarnedOf) {
    GltfBuilder b;
    const int normals = b.floats(std::vector<glm::vec3>{{nan, 0, 0}, {0, 0, 2}, {0, 0, 1}}, "VEC3");
    const int uv = b.floats(std::vector<glm::vec2>{{nan, 0}, {1, 0}, {0, 1}}, "VEC2");
    const int tangents = b.floats(std::vector<glm::vec4>{{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}}, "VEC4");
    b.triangle({{"attributes", {{"NORMAL", normals}, {"TEXCOORD_0", uv}, {"TANGENT", tangents}}}});
    const auto scene = b.load();
    EXPECT_TRUE(warns(*scene, "1 normals are not finite"));
    EXPECT_TRUE(warns(*scene, "texture coordinates"));
    EXPECT_TRUE(warns(*scene, "TANGENT"));
    for (const glm::vec3& n : scene->meshes[0].normals) expectNear(n, {0, 0, 1}, 0);
    EXPECT_EQ(scene->meshes[0].texCoords0[0], glm::vec2(0));
}

TEST(GltfMeshes, AttributesMustBeAsLongAsPositions) {
    GltfBuilder b;
    b.triangle({{"attributes", {{"NORMAL", b.floats(std::vector<glm::vec3>{{0, 0, 1}}, "VEC3")}}}});
    EXPECT_CONTAINS(b.error(), "NORMAL has 1 elements for 3 positions");
}

TEST(GltfMeshes, SharedMeshesAreReadOnceAndInstanced) {
    GltfBuilder b;
    b.triangle();
    b.add("nodes", {{"mesh", 0}, {"translation", {10, 0, 0}}});
    const auto scene = b.load();
    EXPECT_EQ(scene->meshes.size(), 1u);
    EXPECT_EQ(scene->instances.size(), 2u);
    const Geometry g = evaluate(scene, 0).geometry;
    ASSERT_EQ(g.triangles.size(), 2u);
    EXPECT_EQ(g.triangles[1], g.triangles[0] + 3u);
    EXPECT_EQ(g.positions[4], glm::vec3(11, 0, 0));
    EXPECT_EQ(g.instances[1].firstTriangle, 1u);
    EXPECT_EQ(g.instances[1].firstVertex, 3u);
}

TEST(GltfMeshes, NormalMapsGetTangents) {
    GltfBuilder b;
    const int image = b.add("images", {{"bufferView", b.view(tinyPng())}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", image}});
    b.add("materials", {{"normalTexture", {{"index", 0}, {"scale", 0.5}}}});
    const int uv = b.floats(std::vector<glm::vec2>{{0, 0}, {0, 1}, {1, 0}}, "VEC2");
    b.triangle({{"material", 0}, {"attributes", {{"TEXCOORD_0", uv}}}});
    const auto scene = b.load();
    const Mesh& mesh = scene->meshes[0];
    ASSERT_EQ(mesh.tangents.size(), 3u);
    EXPECT_EQ(mesh.tangents[0], glm::vec4(0, 1, 0, -1));
    EXPECT_EQ(scene->materials[0].normalScale, 0.5f);
    EXPECT_FALSE(scene->textures[0].srgb);
}

}  // namespace
}  // namespace voxray::test

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "pbrt_files.h"
#include "scene/geometry.h"

namespace voxray::test {
namespace {

struct Measured {
    double area = 0;
    double volume = 0;     ///< Above 0 where fronts are outside.
    glm::dvec3 normal{0};  ///< Of the fronts, area-weighted mean.
};

Measured measure(const std::shared_ptr<const Scene>& scene) {
    const Geometry g = evaluate(scene, 0).geometry;
    Measured m;
    for (const glm::uvec3& t : g.triangles) {
        const glm::dvec3 a(g.positions[t.x]), b(g.positions[t.y]), c(g.positions[t.z]);
        const glm::dvec3 cross = glm::cross(b - a, c - a);
        m.area += glm::length(cross) / 2;
        m.volume += glm::dot(a, cross) / 6;
        m.normal += cross / 2.0;
    }
    m.normal /= m.area;
    return m;
}

class PbrtShapes : public testing::Test {
 protected:
    Measured measured(const std::string& world) { return measure(loadWorld(folder_, world)); }
    TemporaryFolder folder_;
};

constexpr double pi = 3.14159265358979;

TEST_F(PbrtShapes, QuadricsHaveTheirAreaAndFronts) {
    Measured m = measured("Shape \"sphere\" \"float radius\" 2");
    EXPECT_NEAR(m.area, 16 * pi, 1e-3);
    EXPECT_NEAR(m.volume, 32 * pi / 3, 0.1);
    EXPECT_LT(measured("ReverseOrientation Shape \"sphere\"").volume, 0);
    // A mirrored sphere's front stays outside
    EXPECT_GT(measured("Scale 1 1 -1 Shape \"sphere\"").volume, 0);
    // A zone of height h: 2 π r h, half a turn of it
    m = measured("Shape \"sphere\" \"float radius\" 2 \"float zmin\" 0 \"float zmax\" 1 \"float phimax\" 180");
    EXPECT_NEAR(m.area, 2 * pi * 2 * 1 / 2, 1e-3);
    m = measured("Shape \"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float height\" 3");
    EXPECT_NEAR(m.area, 3 * pi, 1e-3);
    EXPECT_NEAR(m.normal.z, 1, 1e-6);
    EXPECT_NEAR(measured("ReverseOrientation Shape \"disk\"").normal.z, -1, 1e-6);
    m = measured("Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" 1 \"float phimax\" 90");
    EXPECT_NEAR(m.area, 2 * pi, 1e-3);
    EXPECT_GT(m.volume, 0);
}

TEST_F(PbrtShapes, TextureCoordinatesAreThoseOfPbrt) {
    // v of the sphere grows to +Z, that of the disk to its center
    const auto scene = loadWorld(folder_, "Shape \"sphere\" Shape \"disk\" Shape \"cylinder\"");
    for (size_t mesh = 0; mesh < 3; ++mesh) {
        const Mesh& m = scene->meshes[mesh];
        for (size_t i = 0; i < m.positions.size(); ++i) {
            const glm::vec3& p = m.positions[i];
            const double expected = mesh == 0 ? 1 - std::acos(std::clamp(double(p.z) / glm::length(p), -1.0, 1.0)) / pi
                                    : mesh == 1 ? 1 - std::hypot(p.x, p.y)
                                                : (p.z + 1) / 2;
            EXPECT_NEAR(m.texCoords0[i].y, expected, 2e-3) << mesh;
        }
    }
}

TEST_F(PbrtShapes, FrontsAreOnTheSideOfNormals) {
    const std::string points = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] ";
    EXPECT_NEAR(measured(points).normal.z, 1, 1e-6);
    EXPECT_NEAR(measured(points + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]").normal.z, -1, 1e-6);
    EXPECT_NEAR(measured("ReverseOrientation " + points).normal.z, -1, 1e-6);
    EXPECT_NEAR(measured("ReverseOrientation " + points + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]").normal.z, 1, 1e-6);
    const auto scene = loadWorld(folder_, points + "\"normal N\" [0 0 2 0 0 1 0 1 0] \"point2 uv\" [0 0 5 0 0 5]");
    EXPECT_EQ(scene->meshes[0].normals[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(scene->meshes[0].texCoords0[1], glm::vec2(5, 0));
}

TEST_F(PbrtShapes, TexturedMeshesWithoutCoordinatesGetThoseOfPbrt) {
    const std::string quad =
        R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 1 1 0 0 1 0] "integer indices" [0 1 2 0 2 3])";
    auto scene = loadWorld(folder_, quad);
    EXPECT_TRUE(scene->meshes[0].texCoords0.empty());
    scene = loadWorld(
        folder_,
        "Texture \"c\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"c\" " + quad);
    const Mesh& mesh = scene->meshes[0];
    ASSERT_EQ(mesh.texCoords0.size(), 6u);
    EXPECT_EQ(mesh.texCoords0[mesh.triangles[1].y], glm::vec2(1, 0));
    EXPECT_EQ(mesh.positions[mesh.triangles[1].y], glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh.texCoords0[mesh.triangles[1].z], glm::vec2(1, 1));
}

TEST_F(PbrtShapes, BilinearPatches) {
    // A flat one is two triangles; u along the first edge, v to the third corner
    auto scene = loadWorld(folder_, "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 1 0 2 1 0]");
    EXPECT_EQ(scene->meshes[0].triangles.size(), 2u);
    EXPECT_NEAR(measure(scene).normal.z, 1, 1e-6);
    EXPECT_NEAR(measure(scene).area, 2, 1e-6);
    // A saddle of two patches in a list
    scene = loadWorld(folder_,
                      "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 1 0 1 1 1 1 0 2 0 0 2 1 1] "
                      "\"integer indices\" [0 1 2 3 1 4 3 5]");
    EXPECT_EQ(scene->meshes[0].triangles.size(), 2u * 512);
    // ∫∫ √(1 + |∇z|²) of z = x + y - 2xy, by the midpoint rule
    double area = 0;
    for (int i = 0; i < 400; ++i)
        for (int j = 0; j < 400; ++j) {
            const double x = (i + 0.5) / 400, y = (j + 0.5) / 400;
            area += std::sqrt(1 + (1 - 2 * y) * (1 - 2 * y) + (1 - 2 * x) * (1 - 2 * x)) / 160000;
        }
    EXPECT_NEAR(measure(scene).area, 2 * area, 0.005);
}

TEST_F(PbrtShapes, PlyMeshesAndSubdivisionSurfaces) {
    writeText(folder_ / "quad.ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "property uchar red\nproperty uchar green\nproperty uchar blue\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0 9 9 9 1 0 0 9 9 9 1 1 0 9 9 9 0 1 0 9 9 9 4 0 1 2 3\n");
    const auto scene = loadWorld(folder_, "Shape \"plymesh\" \"string filename\" [\"quad.ply\"]");
    EXPECT_EQ(scene->meshes[0].triangles.size(), 2u);
    EXPECT_EQ(scene->meshes[0].name, "quad.ply");
    // pbrt knows no vertex colors
    EXPECT_TRUE(scene->meshes[0].colors.empty());
    const std::string octahedron =
        "Shape \"loopsubdiv\" \"integer levels\" 2 \"point3 P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1] "
        "\"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]";
    EXPECT_GT(measured(octahedron).volume, 0.3);
    // Where it shines its front is that of pbrt's normals
    EXPECT_LT(measured("AreaLightSource \"diffuse\" " + octahedron).volume, -0.3);
    EXPECT_CONTAINS(errorOf([&] { loadWorld(folder_, "Shape \"loopsubdiv\" \"integer levels\" 13"); }), "from 0 to 12");
}

TEST_F(PbrtShapes, WhatIsNotReadIsNamed) {
    const auto scene =
        loadWorld(folder_, kTriangle +
                               "\nShape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 2 2 2] \"float width\" 1\n"
                               "Material \"interface\" Shape \"sphere\"");
    EXPECT_EQ(scene->instances.size(), 1u);
    EXPECT_TRUE(warns(*scene, "curves, such as hair, are left out", "scene.pbrt:6"));
}

TEST_F(PbrtShapes, AlphaCutsHoles) {
    writeText(folder_ / "a.pfm", std::string("Pf\n2 1\n-1\n\0\0\0\0\0\0\x80\x3f", 18));
    const auto scene = loadWorld(folder_, R"(
        Texture "holes" "float" "imagemap" "string filename" "a.pfm"
        Shape "sphere" "texture alpha" "holes"
        Shape "sphere" "float alpha" 0
        Shape "sphere" "float alpha" 0.7
        Shape "sphere" "float alpha" 1)");
    ASSERT_EQ(scene->instances.size(), 3u);
    const Material& masked = scene->materials[scene->meshes[0].material];
    EXPECT_EQ(masked.alphaMode, AlphaMode::Mask);
    ASSERT_GE(masked.baseColorTexture.texture, 0);
    const Texture& texture = scene->textures[size_t(masked.baseColorTexture.texture)];
    EXPECT_EQ(texture.rgba[3], 0);
    EXPECT_EQ(texture.rgba[7], 255);
    EXPECT_EQ(scene->materials[scene->meshes[1].material].alphaMode, AlphaMode::Opaque);
    EXPECT_TRUE(warns(*scene, "alpha of at least 0.5"));
}

}  // namespace
}  // namespace voxray::test

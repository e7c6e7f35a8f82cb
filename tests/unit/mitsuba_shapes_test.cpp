#include <numbers>

#include "mitsuba_files.h"

namespace voxray::test {
namespace {

using std::numbers::pi;

double areaOf(const Geometry& g) {
    double area = 0;
    for (uint32_t t = 0; t < g.triangles.size(); ++t) area += triangleArea(g, t);
    return area;
}

/// Geometry of a scene with one shape of these attributes and elements.
Geometry shapeOf(const TemporaryFolder& folder, const std::string& type, const std::string& elements = "") {
    return evaluate(loadElements(folder, "<shape type='" + type + "'>" + elements + "</shape>"), 0).geometry;
}

std::string fileOf(const std::string& name) {
    return "<string name='filename' value='" + name + "'/>";
}

glm::vec3 frontOf(const Geometry& g, uint32_t triangle) {
    const glm::uvec3 t = g.triangles[triangle];
    return glm::normalize(glm::cross(g.positions[t.y] - g.positions[t.x], g.positions[t.z] - g.positions[t.x]));
}

/// Fronts are on the side of the normals, and all lie on the side of `out` of their place.
void expectFronts(const Geometry& g, const std::function<glm::vec3(const glm::vec3&)>& out) {
    for (uint32_t t = 0; t < g.triangles.size(); ++t) {
        const glm::uvec3 corners = g.triangles[t];
        const glm::vec3 center = (g.positions[corners.x] + g.positions[corners.y] + g.positions[corners.z]) / 3.0f;
        ASSERT_GT(glm::dot(frontOf(g, t), out(center)), 0) << t;
        for (int c = 0; c < 3; ++c) ASSERT_GT(glm::dot(frontOf(g, t), g.attributes[corners[c]].normal), 0) << t;
    }
}

TEST(MitsubaShapes, AreasAndFrontsOfAnalyticShapes) {
    const TemporaryFolder folder;
    const Geometry sphere = shapeOf(folder, "sphere", "<float name='radius' value='2'/>");
    EXPECT_NEAR(areaOf(sphere), 16 * pi, 1e-3);
    expectFronts(sphere, [](const glm::vec3& p) { return p; });
    const Geometry inside = shapeOf(folder, "sphere", "<boolean name='flip_normals' value='true'/>");
    expectFronts(inside, [](const glm::vec3& p) { return -p; });
    EXPECT_NEAR(areaOf(shapeOf(folder, "disk")), pi, 1e-4);
    const Geometry cylinder = shapeOf(folder, "cylinder",
                                      "<point name='p0' value='1 1 1'/><point name='p1' x='1' y='1' "
                                      "z='4'/><float name='radius' value='0.5'/>");
    EXPECT_NEAR(areaOf(cylinder), 3 * pi, 1e-3);
    EXPECT_NEAR(cylinder.boundsMax.z, 4, 1e-5);
    expectFronts(cylinder, [](const glm::vec3& p) { return glm::vec3(p.x - 1, p.y - 1, 0); });
    const Geometry cube = shapeOf(folder, "cube");
    EXPECT_NEAR(areaOf(cube), 24, 1e-4);
    expectFronts(cube, [](const glm::vec3& p) { return p; });
    const Geometry rectangle = shapeOf(folder, "rectangle");
    EXPECT_NEAR(areaOf(rectangle), 4, 1e-5);
    expectFronts(rectangle, [](const glm::vec3&) { return glm::vec3(0, 0, 1); });
}

TEST(MitsubaShapes, MirroredShapesKeepTheirFronts) {
    const TemporaryFolder folder;
    const std::string mirrored = "<transform name='to_world'><scale x='-1' y='2'/></transform>";
    expectFronts(shapeOf(folder, "sphere", mirrored), [](const glm::vec3& p) { return p; });
    expectFronts(shapeOf(folder, "rectangle", mirrored), [](const glm::vec3&) { return glm::vec3(0, 0, 1); });
}

TEST(MitsubaShapes, FrontsOfMeshesAreThoseOfTheirNormals) {
    const TemporaryFolder folder;
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\n";
    writeText(folder / "with.obj", corners + "f 1//1 2//1 3//1\n");
    writeText(folder / "without.obj", corners + "f 1 2 3\n");
    const auto front = [&](const std::string& file, const std::string& more) {
        return frontOf(shapeOf(folder, "obj", fileOf(file) + more), 0).z;
    };
    const std::string flat = "<boolean name='face_normals' value='true'/>";
    const std::string mirror = "<transform name='to_world'><scale x='-1'/></transform>";
    EXPECT_NEAR(front("with.obj", ""), -1, 1e-6);
    EXPECT_NEAR(front("with.obj", flat), 1, 1e-6);
    EXPECT_NEAR(front("without.obj", ""), 1, 1e-6);
    // Normals of the file stay on their side, the order of the vertices is that in the world
    EXPECT_NEAR(front("with.obj", mirror), -1, 1e-6);
    EXPECT_NEAR(front("without.obj", mirror), -1, 1e-6);
    EXPECT_NEAR(front("without.obj", flat + mirror), -1, 1e-6);
}

TEST(MitsubaShapes, ObjFiles) {
    const TemporaryFolder folder;
    writeText(folder / "a.obj",
              "# quad\r\no name\nv 0 0 0\r\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 0.75\n"
              "vt 0 1\nusemtl x\ns 1\nf -4/1 -3/2 -2/3 -1/4 # end");
    const auto scene = loadElements(folder, "<shape type='obj'>" + fileOf("a.obj") + "</shape>");
    ASSERT_EQ(scene->meshes.size(), 1u);
    EXPECT_EQ(scene->meshes[0].triangles.size(), 2u);
    EXPECT_EQ(scene->meshes[0].positions.size(), 4u);
    EXPECT_EQ(scene->meshes[0].texCoords0[2], glm::vec2(1, 0.25f));
    EXPECT_EQ(scene->meshes[0].normals[0], glm::vec3(0, 0, 1));
    for (const char* broken : {"v 0 0\nf 1 1 1", "v 0 0 0\nf 1 2 3", "v 0 0 0\nf 1 1 x", "v 0 0 0\nf 1/2 1 1",
                               "v 0 0 0\nf 0 1 1", "v 0 0 0\nf -2 1 1", "v nan 0 0\nf 1 1 1"}) {
        writeText(folder / "a.obj", broken);
        EXPECT_CONTAINS(errorOf([&] { shapeOf(folder, "obj", fileOf("a.obj")); }), "a.obj:");
    }
}

TEST(MitsubaShapes, SerializedFilesOfBothVersions) {
    const TemporaryFolder folder;
    for (const uint16_t version : {uint16_t(3), uint16_t(4)})
        for (const uint32_t flags : {0x1000u, 0x2000u, 0x1002u, 0x2002u}) {
            writeText(folder / "a.serialized", serializedFile(version, flags, 3));
            const auto scene = loadElements(folder, "<shape type='serialized'><integer name='shape_index' value='2'/>" +
                                                        fileOf("a.serialized") + "</shape>");
            EXPECT_EQ(scene->meshes.at(0).positions[0], glm::vec3(2, 0, 0)) << version << " " << flags;
            EXPECT_EQ(scene->meshes[0].texCoords0.empty(), (flags & 2) == 0);
            if ((flags & 2) == 0) continue;
            EXPECT_EQ(scene->meshes[0].texCoords0[0], glm::vec2(0, 0.25f));
        }
    const std::string third = "<integer name='shape_index' value='3'/>" + fileOf("a.serialized");
    EXPECT_CONTAINS(errorOf([&] { shapeOf(folder, "serialized", third); }), "no mesh 3");
    writeText(folder / "a.serialized", serializedFile(4, 0x1000, 1).substr(0, 40));
    EXPECT_CONTAINS(errorOf([&] { shapeOf(folder, "serialized", fileOf("a.serialized")); }), "a.serialized: ");
}

TEST(MitsubaShapes, GroupsAndInstances) {
    const TemporaryFolder folder;
    const auto scene = loadElements(folder, R"(
        <shape type="shapegroup" id="g">
            <shape type="rectangle"><transform name="to_world"><translate z="1"/></transform></shape>
            <shape type="cube"/>
            <shape type="instance"><ref id="other"/></shape>
        </shape>
        <shape type="shapegroup" id="other"><shape type="cube"/></shape>
        <shape type="instance"><ref id="g"/></shape>
        <shape type="instance"><ref id="g"/><transform name="to_world"><translate x="10"/></transform></shape>)");
    EXPECT_EQ(scene->meshes.size(), 2u);
    EXPECT_EQ(scene->instances.size(), 4u);
    EXPECT_EQ(evaluate(scene, 0).geometry.boundsMax.x, 11);
    EXPECT_TRUE(warns(*scene, "'instance' shapes are left out"));
    EXPECT_ERROR("shapegroup", loadElements(folder, "<shape type='instance'/>"));
}

TEST(MitsubaShapes, MergedShapes) {
    const TemporaryFolder folder;
    const std::string merge = "<shape type='merge' id='m'><shape type='cube' id='c'/><shape type='disk'/></shape>";
    EXPECT_EQ(loadElements(folder, merge)->instances.size(), 2u);
    std::string chain = "<shape type='cube' id='s0'/>";
    for (int i = 1; i < 60; ++i)
        chain += fmt::format("<shape type='merge' id='s{0}'><ref id='s{1}'/><ref id='s{1}'/></shape>", i, i - 1);
    EXPECT_TRUE(warns(*loadElements(folder, chain), "'merge' shapes are left out"));
}

TEST(MitsubaShapes, EmittersAndMaterialsOfShapes) {
    const TemporaryFolder folder;
    const auto scene = loadElements(folder, R"(
        <bsdf type="diffuse" id="m"><rgb name="reflectance" value="0.25"/></bsdf>
        <shape type="rectangle"><ref id="m"/><emitter type="area"><rgb name="radiance" value="1 2 3"/></emitter></shape>
        <emitter type="area" id="e"/>
        <shape type="disk"><ref id="e"/></shape>
        <shape type="rectangle"><ref id="m"/></shape>
        <shape type="rectangle"><ref id="m"/></shape>
        <shape type="rectangle"/>
        <shape type="rectangle"><bsdf type="null"/></shape>)");
    ASSERT_EQ(scene->instances.size(), 5u);
    EXPECT_EQ(scene->materials.size(), 4u);
    EXPECT_EQ(scene->materials[0].emission, glm::vec3(1, 2, 3));
    EXPECT_FALSE(scene->materials[0].doubleSided);
    EXPECT_EQ(scene->materials[1].emission, glm::vec3(1));
    EXPECT_FALSE(warns(*scene, "emitters"));
    EXPECT_EQ(scene->materials[2].emission, glm::vec3(0));
    EXPECT_EQ(scene->meshes[2].material, scene->meshes[3].material);
    EXPECT_EQ(scene->materials[3].baseColor, glm::vec4(0.5f, 0.5f, 0.5f, 1));
}

}  // namespace
}  // namespace voxray::test

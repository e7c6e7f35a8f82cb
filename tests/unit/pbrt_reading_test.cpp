#include "pbrt_files.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <glm/geometric.hpp>

#include "scene/geometry.h"

namespace voxray::test {
namespace {

std::string refusalOf(const TemporaryFolder& folder, const std::string& world) {
    return errorOf([&] { loadWorld(folder, world); });
}

/// Corners of the whole scene in the world.
std::pair<glm::vec3, glm::vec3> boundsOf(const std::shared_ptr<const Scene>& scene) {
    const Geometry g = evaluate(scene, 0).geometry;
    return {g.boundsMin, g.boundsMax};
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(PbrtReading, BracketsQuotesAndCommentsAsPbrtHasThem) {
    const TemporaryFolder folder;
    const auto scene = loadWorld(folder, R"(
        Material "diffuse" # a comment with "quotes" and [
            "rgb reflectance" [ 0.1 .2 3e-1 ]   Shape "sphere" "float radius" [2]
        Material "diffuse" "float reflectance" 0.5#no space
        Shape"disk" "bool unknown" true "string other" "a \"b\""
        Transform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1] Shape "sphere" Transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1
        Option "bool forcediffuse" true Option "string msereferenceimage" "x.exr"
        WorldEnd)");
    ASSERT_EQ(scene->instances.size(), 3u);
    expectNear(glm::vec3(scene->materials[0].baseColor), {0.1f, 0.2f, 0.3f});
    expectNear(glm::vec3(scene->materials[1].baseColor), glm::vec3(0.5f));
    EXPECT_TRUE(warns(*scene, "parameter 'unknown' of Shape is left out", "scene.pbrt:"));
    EXPECT_NEAR(boundsOf(scene).second.z, 8, 0.02);
}

TEST(PbrtReading, TransformsFollowEachOther) {
    const TemporaryFolder folder;
    // The point (1, 0, 0): scaled, turned to +Y, moved; saved and restored
    const auto scene = loadWorld(folder, R"(
        CoordinateSystem "here"
        AttributeBegin
            Translate 10 0 0  Rotate 90 0 0 1  Scale 2 1 1
            TransformBegin ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 -50 1] TransformEnd
            Shape "trianglemesh" "point3 P" [1 0 0  1 0 0.5  1 0.001 0]
        AttributeEnd
        Identity CoordSysTransform "here"
        Shape "trianglemesh" "point3 P" [-1 0 0  -1 0 0.5  -1 0.001 0])");
    const auto [low, high] = boundsOf(scene);
    expectNear(low, {-1, 0, 0});
    expectNear(high, {10, 2, 0.5f});
}

TEST(PbrtReading, CameraSpaceHasTheCameraInItsOrigin) {
    const TemporaryFolder folder;
    // A triangle two units before the eye, which is at (0, 0, 5) and looks along -Z
    const auto scene = loadWorld(folder, R"(
        CoordSysTransform "camera" Translate 0 0 2
        Shape "trianglemesh" "point3 P" [0 0 0  0.001 0 0  0 0.001 0])");
    EXPECT_NEAR(boundsOf(scene).first.z, 3, 1e-5);
}

TEST(PbrtReading, MotionStandsStillAtTheStart) {
    const TemporaryFolder folder;
    const auto scene = loadWorld(
        folder, "TransformTimes 0 1 ActiveTransform EndTime Translate 9 0 0 ActiveTransform All " + kTriangle);
    expectNear(boundsOf(scene).second, {1, 1, 0});
    EXPECT_TRUE(warns(*scene, "when the shutter opens"));
}

TEST(PbrtReading, IncludesAreRelativeToTheRootFile) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "parts");
    writeText(folder / "parts/a.pbrt", "Material \"diffuse\" \"rgb reflectance\" [1 0 0] Include \"parts/b.pbrt\"");
    writeText(folder / "parts/b.pbrt", kTriangle + "Translate 0 0 3");
    const std::string path = (folder / "parts/c.pbrt.gz").string();
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, kTriangle.data(), unsigned(kTriangle.size()));
    gzclose(file);
    // What an included file changes stays, what an imported one changes does not
    auto scene = loadWorld(folder, "Include \"parts/a.pbrt\" Include \"parts/c.pbrt.gz\"");
    ASSERT_EQ(scene->instances.size(), 2u);
    EXPECT_EQ(boundsOf(scene).second.z, 3);
    EXPECT_EQ(scene->materials.size(), 1u);
    scene = loadWorld(folder, "Import \"parts/a.pbrt\" " + kTriangle);
    EXPECT_EQ(boundsOf(scene).second.z, 0);
    EXPECT_EQ(scene->materials.size(), 2u);

    EXPECT_CONTAINS(refusalOf(folder, "\n\nInclude \"parts/x.pbrt\""),
                    "scene.pbrt:6: Include \"parts/x.pbrt\": there is no file");
    writeText(folder / "parts/a.pbrt", "Include \"parts/a.pbrt\"");
    EXPECT_CONTAINS(refusalOf(folder, "Include \"parts/a.pbrt\""), "a.pbrt:1: Include \"parts/a.pbrt\" is nested");
}

TEST(PbrtReading, ObjectsAreInstanced) {
    const TemporaryFolder folder;
    const auto scene =
        loadWorld(folder, "Translate 0 0 1 ObjectBegin \"o\" Translate 0 2 0 AreaLightSource \"diffuse\" " + kTriangle +
                              kTriangle + R"(ObjectEnd
        AttributeBegin Scale 10 10 10 ObjectInstance "o" AttributeEnd ObjectInstance "o")");
    EXPECT_EQ(scene->meshes.size(), 2u);
    ASSERT_EQ(scene->instances.size(), 4u);
    // The instance's transform times that of the object's shape: z = 1 + 10 * (1), 1 + 1
    const auto [low, high] = boundsOf(scene);
    expectNear(low, {0, 2, 2});
    expectNear(high, {10, 30, 11});
    EXPECT_EQ(scene->materials[0].emission, glm::vec3(0));
    EXPECT_TRUE(warns(*scene, "objects do not shine"));
    EXPECT_CONTAINS(refusalOf(folder, "ObjectInstance \"x\""), "no ObjectBegin defines \"x\"");
    EXPECT_CONTAINS(refusalOf(folder, "ObjectBegin \"x\" ObjectBegin \"y\""), "within another object");
    EXPECT_CONTAINS(refusalOf(folder, "ObjectBegin \"x\""), "has no end");
    EXPECT_CONTAINS(refusalOf(folder, "ObjectBegin \"x\" AttributeEnd"), "ends what no AttributeBegin began");
}

TEST(PbrtReading, AttributesAreDefaultsOfDirectives) {
    const TemporaryFolder folder;
    const auto scene = loadWorld(folder, R"(
        AttributeBegin
            Attribute "shape" "float radius" 3
            Attribute "material" "rgb reflectance" [0 0 1]
            Material "diffuse" Shape "sphere" Shape "sphere" "float radius" 4
        AttributeEnd
        Material "diffuse" Translate 100 0 0 Shape "sphere")");
    ASSERT_EQ(scene->instances.size(), 3u);
    EXPECT_EQ(glm::vec3(scene->materials[0].baseColor), glm::vec3(0, 0, 1));
    EXPECT_EQ(glm::vec3(scene->materials[1].baseColor), glm::vec3(0.5f));
    const auto [low, high] = boundsOf(scene);
    EXPECT_NEAR(low.x, -4, 0.03);
    EXPECT_NEAR(high.x, 101, 0.03);
}

TEST(PbrtReading, TheFieldOfViewIsThatOfTheShorterSide) {
    const TemporaryFolder folder;
    const auto fovOf = [&](const std::string& size, const std::string& camera) {
        const auto scene = loadPbrtText(folder, "Film \"rgb\" " + size + " Scale -1 1 1 Camera \"perspective\" " +
                                                    camera + " WorldBegin " + kTriangle);
        return scene->cameras.at(0).verticalFovRadians * 57.29578f;
    };
    const std::string wide = "\"integer xresolution\" 200 \"integer yresolution\" 100";
    const std::string high = "\"integer xresolution\" 100 \"integer yresolution\" 200";
    EXPECT_NEAR(fovOf(wide, "\"float fov\" 40"), 40, 1e-4);
    EXPECT_NEAR(std::tan(fovOf(high, "\"float fov\" 40") / 114.59156f), 2 * std::tan(20 / 57.29578f), 1e-4);
    EXPECT_NEAR(fovOf(wide, ""), 90, 1e-4);
    EXPECT_NEAR(std::tan(fovOf(wide, "\"float screenwindow\" [-1 1 -0.5 0.5]") / 114.59156f), 0.5, 1e-4);
    EXPECT_NEAR(std::tan(fovOf(wide, "\"float frameaspectratio\" 0.5") / 114.59156f), 2, 1e-4);
}

TEST(PbrtReading, HandednessIsThatOfTheCamera) {
    const TemporaryFolder folder;
    // Right-handed by a negative scale: nothing is mirrored
    auto scene = loadWorld(folder, kTriangle);
    expectNear(scene->cameras.at(0).position, {0, 0, 5});
    expectNear(scene->cameras[0].forward, {0, 0, -1});
    expectNear(boundsOf(scene).second, {1, 1, 0});
    // pbrt's own left-handed world: +X is on the right of a camera that looks along +Z
    scene = loadPbrtText(folder,
                         "LookAt 0 0 -5  0 0 0  0 1 0 Camera \"perspective\" WorldBegin LightSource \"point\" "
                         "\"point3 from\" [3 0 0] " +
                             kTriangle);
    expectNear(scene->cameras.at(0).forward, {0, 0, 1});
    expectNear(boundsOf(scene).first, {-1, 0, 0});
    expectNear(scene->lights.at(0).position, {-3, 0, 0});
    EXPECT_TRUE(warns(*scene, "mirrored"));
}

TEST(PbrtReading, TheFilmsExposureIsSaid) {
    const TemporaryFolder folder;
    const auto scene =
        loadPbrtText(folder, R"(Film "rgb" "float iso" 400 "string sensor" "canon_eos_5d" "float maxcomponentvalue" 9
        Scale -1 1 1 Camera "perspective" "float shutterclose" 0.5 "float lensradius" 0.1 "float focaldistance" 3 WorldBegin )" +
                                 kTriangle);
    EXPECT_TRUE(warns(*scene, "image.exposure_stops", "1.000 stops"));
    EXPECT_TRUE(warns(*scene, "sensor", "canon_eos_5d"));
    EXPECT_TRUE(warns(*scene, "depth of field"));
    EXPECT_TRUE(warns(*scene, "'maxcomponentvalue' of Film"));
}

TEST(PbrtReading, ErrorsNameFileAndLine) {
    const TemporaryFolder folder;
    const std::string at = (folder / "scene.pbrt").string() + ":5: ";
    const auto says = [&](const std::string& world, const std::string& message) {
        const std::string refusal = refusalOf(folder, "\n" + world);
        EXPECT_CONTAINS(refusal, at);
        EXPECT_CONTAINS(refusal, message);
    };
    says("Shap \"sphere\"", "unknown directive 'Shap'; did you mean 'Shape'?");
    says("SurfaceIntegrator \"path\"", "pbrt --upgrade");
    says("\"sphere\"", "stands where a directive begins");
    says("Shape sphere", "'sphere' stands where Shape wants a string");
    says("Shape \"spher\"", "\"spher\" is unknown; did you mean 'sphere'?");
    says("Shape \"sphere\" \"radius\" 2", "\"radius\" stands where a parameter is declared");
    says("Shape \"sphere\" \"real radius\" 2", "'real' is no type");
    says("Shape \"sphere\" \"point P\" [1 2 3]", "pbrt --upgrade");
    says("Shape \"sphere\" \"float radius\" [1 2]", "'radius' has 2 values");
    says("Shape \"sphere\" \"float radius\" \"big\"", "'big' stands where parameter 'radius' wants");
    says("Shape \"sphere\" \"float radius\" 1x", "'1x' is no number");
    says("Shape \"sphere\" \"float radius\" -1", "'radius' is -1; it is above 0");
    says("Shape \"sphere\" \"float radius\" [1", "a ] is missing");
    says("Shape \"sphere\" \"string", "no closing quote");
    says("Shape \"trianglemesh\" \"point3 P\" [0 0]", "'P' has 2 numbers");
    says("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3]", "names vertex 3");
    says("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1]", "'N' has 1 values");
    says("Shape \"plymesh\" \"string filename\" \"no.ply\"", "there is no file");
    says("Rotate 90 0 0 0", "the axis of Rotate is 0");
    says("Translate 1 2", "the file ends where Translate wants a number");
    says("LookAt 0 0 0 0 0 0 0 1 0", "looks nowhere");
    says("CoordSysTransform \"x\"", "no CoordinateSystem \"x\"");
    says("AttributeEnd", "ends what no AttributeBegin began");
    says("NamedMaterial \"wal\" " + kTriangle + "MakeNamedMaterial \"wall\" \"string type\" \"diffuse\"",
         "did you mean 'wall'?");
    says("Material \"matte\" " + kTriangle, "pbrt --upgrade");
    says("Material \"difuse\" " + kTriangle, "did you mean 'diffuse'?");
    says("Material \"diffuse\" \"texture reflectance\" \"t\" " + kTriangle, "\"t\", which is not defined");
    says("LightSource \"sun\" " + kTriangle, "the light \"sun\" is unknown");
    says("AreaLightSource \"sphere\"", "AreaLightSource \"sphere\" is unknown");
    says("ColorSpace \"rgb\"", "ColorSpace \"rgb\" is unknown");
    says("Texture \"t\" \"color\" \"constant\"", "\"float\" and \"spectrum\"");
    EXPECT_CONTAINS(refusalOf(folder, ""), "no triangles");
    EXPECT_CONTAINS(errorOf([&] { loadPbrtText(folder, "AttributeBegin"); }),
                    "scene.pbrt: 1 of 'AttributeBegin' has no end");
}

}  // namespace
}  // namespace voxray::test

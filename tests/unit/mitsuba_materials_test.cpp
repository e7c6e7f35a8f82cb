#include "image/image.h"
#include "mitsuba_files.h"
#include "scene/import/optics.h"
#include "scene/panes.h"

namespace voxray::test {
namespace {

std::shared_ptr<const Scene> sceneOf(const TemporaryFolder& folder, const std::string& bsdf) {
    return loadElements(folder, "<shape type='rectangle'>" + bsdf + "</shape>");
}

Material materialOf(const TemporaryFolder& folder, const std::string& bsdf) {
    return sceneOf(folder, bsdf)->materials.at(0);
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(MitsubaMaterials, Lambert) {
    const TemporaryFolder folder;
    const auto scene = sceneOf(folder,
                               "<bsdf type='twosided'><bsdf type='diffuse'>"
                               "<rgb name='reflectance' value='0.1, 0.2, 0.3'/></bsdf></bsdf>");
    const Material& m = scene->materials.at(0);
    expectNear(m.baseColor, {0.1f, 0.2f, 0.3f}, 1e-6f);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.specular, 0);
    EXPECT_TRUE(scene->warnings.empty()) << scene->warnings[0];
    expectNear(materialOf(folder, "<bsdf type='diffuse'/>").baseColor, glm::vec3(0.5f), 1e-6f);
    expectNear(materialOf(folder, "<bsdf type='diffuse'><spectrum name='reflectance' value='0.75'/></bsdf>").baseColor,
               glm::vec3(0.75f), 1e-6f);
    expectNear(
        materialOf(folder, "<bsdf type='diffuse'><spectrum name='reflectance' value='300:0.25, 900:0.25'/></bsdf>")
            .baseColor,
        glm::vec3(0.25f), 1e-3f);
    expectNear(materialOf(folder, "<bsdf type='diffuse'><srgb name='reflectance' value='0.5 1 0'/></bsdf>").baseColor,
               {0.21404f, 1, 0}, 1e-4f);
    const auto bright = sceneOf(folder, "<bsdf type='diffuse'><rgb name='reflectance' value='2'/></bsdf>");
    EXPECT_TRUE(warns(*bright, "above 1"));
    EXPECT_TRUE(warns(*bright, "without 'twosided'"));
}

TEST(MitsubaMaterials, Conductors) {
    const TemporaryFolder folder;
    const Material gold = materialOf(folder, "<bsdf type='conductor'><string name='material' value='Au'/></bsdf>");
    EXPECT_EQ(gold.metallic, 1);
    EXPECT_EQ(gold.roughness, 0);
    EXPECT_GT(gold.baseColor.x, gold.baseColor.z + 0.3f);
    const Material own = materialOf(folder,
                                    "<bsdf type='roughconductor'><float name='alpha' value='0.25'/>"
                                    "<spectrum name='eta' value='2'/><spectrum name='k' value='3'/></bsdf>");
    EXPECT_EQ(own.roughness, 0.5f);
    EXPECT_NEAR(own.baseColor.x, (1 + 9) / (9.0 + 9), 1e-3);
    const Material none = materialOf(folder,
                                     "<bsdf type='conductor'><string name='material' value='none'/>"
                                     "<rgb name='specular_reflectance' value='0.5'/></bsdf>");
    expectNear(none.baseColor, glm::vec3(0.5f), 1e-6f);
    EXPECT_ERROR("no metal 'Xx'",
                 materialOf(folder, "<bsdf type='conductor'><string name='material' value='Xx'/></bsdf>"));
}

TEST(MitsubaMaterials, PlasticKeepsItsBase) {
    const TemporaryFolder folder;
    const std::string base =
        "<rgb name='diffuse_reflectance' value='0.4'/><float name='int_ior' value='1.5'/>"
        "<float name='ext_ior' value='1'/>";
    const Material linear = materialOf(folder, "<bsdf type='plastic'>" + base + "</bsdf>");
    EXPECT_NEAR(linear.baseColor.x, 0.4, 1e-6);
    EXPECT_EQ(linear.specular, 1);
    EXPECT_NEAR(linear.ior, 1.5, 1e-6);
    EXPECT_EQ(linear.roughness, 0);
    const Material darker =
        materialOf(folder, "<bsdf type='roughplastic'>" + base + "<boolean name='nonlinear' value='true'/></bsdf>");
    EXPECT_NEAR(darker.baseColor.x, coatedReflectance(0.4f, internalDiffuseReflectance(1.5f)), 1e-5);
    EXPECT_LT(darker.baseColor.x, 0.25f);
    EXPECT_NEAR(darker.roughness, std::sqrt(0.1), 1e-6);
}

TEST(MitsubaMaterials, CoatsOverLambert) {
    const TemporaryFolder folder;
    const std::string index = "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>";
    const Material coated = materialOf(folder, "<bsdf type='coating'>" + index +
                                                   "<bsdf type='diffuse'>"
                                                   "<rgb name='reflectance' value='0.4'/></bsdf></bsdf>");
    EXPECT_NEAR(coated.baseColor.x, coatedReflectance(0.4f, internalDiffuseReflectance(1.5f)), 1e-5);
    EXPECT_NEAR(coated.ior, 1.5, 1e-5);
    EXPECT_TRUE(warns(*sceneOf(folder, "<bsdf type='coating'><bsdf type='conductor'/></bsdf>"), "are lost"));
}

TEST(MitsubaMaterials, GlassIsPanes) {
    const TemporaryFolder folder;
    const Material glass = materialOf(folder, "<bsdf type='dielectric'/>");
    EXPECT_TRUE(isPane(glass));
    EXPECT_NEAR(glass.baseColor.x, 1 - 0.0405, 1e-3);
    EXPECT_TRUE(warns(*sceneOf(folder, "<bsdf type='roughdielectric'/>"), "become panes"));
    EXPECT_ERROR("no index of refraction",
                 materialOf(folder, "<bsdf type='dielectric'><string name='int_ior' value='jelly'/></bsdf>"));
}

TEST(MitsubaMaterials, BlendsMasksAndUnknownOnes) {
    const TemporaryFolder folder;
    const auto blend = sceneOf(folder,
                               "<bsdf type='blendbsdf'><float name='weight' value='0.25'/>"
                               "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
                               "<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf></bsdf>");
    EXPECT_NEAR(blend->materials[0].baseColor.x, 0.25, 1e-6);
    EXPECT_TRUE(warns(*blend, "'blendbsdf'"));
    const Material mask =
        materialOf(folder, "<bsdf type='mask'><float name='opacity' value='0.25'/><bsdf type='diffuse'/></bsdf>");
    EXPECT_EQ(mask.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(mask.baseColor.w, 0.25f);
    const auto unknown = sceneOf(folder, "<bsdf type='fabric' id='cloth'/>");
    EXPECT_TRUE(warns(*unknown, "'fabric' materials are not known"));
    EXPECT_TRUE(warns(*unknown, "cloth ("));
    EXPECT_ERROR("no BSDF in it", materialOf(folder, "<bsdf type='mask'/>"));
}

TEST(MitsubaMaterials, Principled) {
    const TemporaryFolder folder;
    const auto scene = sceneOf(folder,
                               "<bsdf type='principled'><rgb name='base_color' value='0.8 0.4 0.2'/>"
                               "<float name='metallic' value='0.75'/><float name='roughness' value='0.25'/>"
                               "<float name='clearcoat' value='1'/></bsdf>");
    const Material& m = scene->materials[0];
    expectNear(m.baseColor, {0.8f, 0.4f, 0.2f}, 1e-6f);
    EXPECT_EQ(m.metallic, 0.75f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_NEAR(m.ior, 1.5, 1e-5);  // Specular 0.5: 4 %
    EXPECT_TRUE(warns(*scene, "'clearcoat'"));
}

TEST(MitsubaMaterials, Textures) {
    const TemporaryFolder folder;
    ImageF picture(2, 1, 3, 0.5f);
    picture.pixel(1, 0)[0] = 1;
    writePng(folder / "a.png", picture);
    const auto textured = [&](const std::string& more) {
        return sceneOf(folder,
                       "<bsdf type='diffuse'><texture type='bitmap' name='reflectance'>"
                       "<string name='filename' value='a.png'/>" +
                           more + "</texture></bsdf>");
    };
    const auto plain = textured("");
    ASSERT_EQ(plain->textures.size(), 1u);
    EXPECT_TRUE(plain->textures[0].srgb);
    EXPECT_EQ(int(plain->textures[0].rgba[4]), 255);
    EXPECT_NEAR(int(plain->textures[0].rgba[0]), 128, 1);
    const auto raw = textured("<boolean name='raw' value='true'/>");
    EXPECT_NEAR(int(raw->textures.at(0).rgba[0]), 188, 1);  // sRGB of 0.5
    const auto placed = textured(
        "<transform name='to_uv'><scale x='2' y='3'/><translate x='0.5'/></transform>"
        "<string name='wrap_mode' value='mirror'/><string name='filter_type' value='nearest'/>");
    const TextureRef& ref = placed->materials[0].baseColorTexture;
    expectNear(ref.transform[0], {2, 0, 0.5f}, 1e-6f);
    expectNear(ref.transform[1], {0, 3, 0}, 1e-6f);
    EXPECT_EQ(placed->textures[0].wrapU, Wrap::MirroredRepeat);
    EXPECT_EQ(placed->textures[0].filter, TexelFilter::Nearest);
    const auto missing = sceneOf(folder,
                                 "<bsdf type='diffuse'><texture type='bitmap' name='reflectance'>"
                                 "<string name='filename' value='b.png'/></texture></bsdf>");
    EXPECT_TRUE(warns(*missing, "images that are missing"));
    expectNear(missing->materials[0].baseColor, glm::vec3(0.5f), 1e-6f);
}

TEST(MitsubaMaterials, TexturesThatNoShapeUsesAreNotRead) {
    const TemporaryFolder folder;
    const auto scene = loadElements(folder,
                                    "<texture type='bitmap' id='t'><string name='filename' value='no.exr'/></texture>"
                                    "<bsdf type='diffuse'><ref name='reflectance' id='t'/></bsdf>"
                                    "<shape type='rectangle'/>");
    EXPECT_FALSE(warns(*scene, "missing"));
}

TEST(MitsubaMaterials, Checkerboard) {
    const TemporaryFolder folder;
    const auto scene = sceneOf(folder,
                               "<bsdf type='diffuse'><texture type='checkerboard' name='reflectance'>"
                               "<rgb name='color0' value='1'/><rgb name='color1' value='0'/></texture></bsdf>");
    const Texture& t = scene->textures.at(0);
    ASSERT_EQ(t.rgba.size(), 16u);
    EXPECT_EQ(t.filter, TexelFilter::Nearest);
    EXPECT_EQ(int(t.rgba[0]), 255);
    EXPECT_EQ(int(t.rgba[4]), 0);
    EXPECT_EQ(int(t.rgba[8]), 0);
    EXPECT_EQ(int(t.rgba[12]), 255);
}

}  // namespace
}  // namespace voxray::test

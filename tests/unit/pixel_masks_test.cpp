#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "experiment/pixel_masks.h"
#include "scene/shapes.h"
#include "tests/support/errors.h"

namespace voxray {
namespace {

constexpr uint32_t kHeight = 8;

/// Two walls 2 m in front of the camera that meet at the center of the image: wood left of it, a mirror right
/// of it. Above y = 0.5 m, three quarters of the image's half height, there is nothing.
SceneState twoWalls() {
    SceneBuilder b("walls");
    Material mirror;
    mirror.name = "mirror";
    mirror.metallic = 1;
    mirror.roughness = 0.05f;
    b.quad("left", {-10, -10, 0}, {10, 0, 0}, {0, 10.5f, 0}, b.lambert("wood", glm::vec3(0.5f)));
    b.quad("right", {0, -10, 0}, {10, 0, 0}, {0, 10.5f, 0}, b.material(mirror));
    b.camera({0, 0, 2}, {0, 0, 0}, float(2 * std::atan(1.0 / 3) * 180 / M_PI));
    return evaluate(b.finish(), 0);
}

MaskSettings mask(const std::string& material, const std::string& object = "", float minMetallic = 0,
                  float maxRoughness = 1) {
    MaskSettings m;
    m.name = "m";
    m.material = material;
    m.object = object;
    m.minMetallic = minMetallic;
    m.maxRoughness = maxRoughness;
    return m;
}

/// Rows of '#' for selected pixels.
std::string picture(const MaskSettings& settings, uint32_t width) {
    const SceneState state = twoWalls();
    const PixelSelection selection = selectPixels({settings}, state, state.cameras.at(0), width, kHeight).at(0);
    std::string rows;
    for (size_t i = 0; i < selection.pixels.size(); ++i) {
        rows += selection.pixels[i] ? '#' : '.';
        if ((i + 1) % width == 0) rows += '\n';
    }
    EXPECT_EQ(selection.count, size_t(std::count(rows.begin(), rows.end(), '#')));
    return rows;
}

std::string rows(const std::string& empty, const std::string& full) {
    // The image is 2/3 m high on each side of its center: 0.5 m is 3 of 4 rows.
    return empty + "\n" + full + "\n" + full + "\n" + full + "\n" + full + "\n" + full + "\n" + full + "\n" + full +
           "\n";
}

TEST(PixelMasks, SelectByMaterialObjectAndMirror) {
    const std::string left = rows("......", "###..."), right = rows("......", "...###");
    EXPECT_EQ(picture(mask("wood"), 6), left);
    EXPECT_EQ(picture(mask("", "right"), 6), right);
    EXPECT_EQ(picture(mask("", "", 0.9f, 0.1f), 6), right);
    EXPECT_EQ(picture(mask("", "", 0.9f, 0.01f), 6), rows("......", "......"));
    EXPECT_EQ(picture(mask("wood", "right"), 6), rows("......", "......"));
    EXPECT_EQ(picture(mask("", "", 0, 1), 6), rows("......", "######"));
}

TEST(PixelMasks, PixelsThatMixSurfacesAreInNeither) {
    EXPECT_EQ(picture(mask("wood"), 5), rows(".....", "##..."));
    EXPECT_EQ(picture(mask("mirror"), 5), rows(".....", "...##"));
}

TEST(PixelMasks, ThatSelectNothingOrAllAreWarnedOf) {
    const SceneState state = twoWalls();
    const auto warnings = [&](const MaskSettings& settings, Camera camera) {
        return maskWarnings({settings}, selectPixels({settings}, state, camera, 6, kHeight), state);
    };
    const Camera& sky = state.cameras.at(0);
    Camera closer = sky;
    closer.position.z = 0.5f;  // Within half a metre of the walls, which fill its view.
    EXPECT_TRUE(warnings(mask("wood"), sky).empty());
    EXPECT_TRUE(warnings(mask("", "", 0, 1), sky).empty());
    EXPECT_EQ(warnings(mask("", "", 0, 1), closer).size(), 1u);
    EXPECT_CONTAINS(warnings(mask("", "", 0, 1), closer).at(0).str(), "measure.masks.m: it selects every pixel");

    // Out of sight, or nowhere
    Camera left = closer;
    left.position.x = -5;
    EXPECT_CONTAINS(warnings(mask("mirror"), left).at(0).str(), "is out of sight");
    for (const MaskSettings& nowhere : {mask("wood", "right"), mask("", "", 0.9f, 0.01f)})
        EXPECT_CONTAINS(warnings(nowhere, sky).at(0).str(), "no surface of the scene meets all of its conditions");
}

TEST(PixelMasks, UnknownNamesAreErrors) {
    const SceneState state = twoWalls();
    for (const MaskSettings& unknown : {mask("wodo"), mask("", "lef")})
        EXPECT_THROW(selectPixels({unknown}, state, state.cameras.at(0), 4, 4), UsageError);
}

TEST(PrimaryHits, HaveDepthAndNumbers) {
    const SceneState state = twoWalls();
    const std::vector<PrimaryHit> hits = primaryHits(state, state.cameras.at(0), 6, kHeight);
    ASSERT_EQ(hits.size(), 48u);
    for (size_t i = 0; i < hits.size(); ++i) {
        const bool isSky = i < 6, isLeft = i % 6 < 3;
        EXPECT_EQ(hits[i].instance, isSky ? -1 : isLeft ? 0 : 1) << i;
        EXPECT_EQ(hits[i].material, isSky ? -1 : isLeft ? 0 : 1) << i;
        if (isSky)
            EXPECT_TRUE(std::isinf(hits[i].depth)) << i;
        else
            EXPECT_NEAR(hits[i].depth, 2, 1e-5) << i;  // Along the axis, not along the ray.
    }
}

}  // namespace
}  // namespace voxray

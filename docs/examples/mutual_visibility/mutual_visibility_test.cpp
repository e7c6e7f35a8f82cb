// The example of docs/voxel-march.md: what a pixel of Cornell sees, by voxels and by shadow rays through
// triangles.
#include <gtest/gtest.h>

#include "passes/common/view/gbuffer.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSide = 96;

TEST(MutualVisibility, IsThatOfShadowRaysButForAFewVoxels) {
    // From the floor before the boxes.
    constexpr uint32_t x = 48, y = 92;
    Chain chain(
        "cornell", "{lights: point}",
        graphYaml({"gbuffer", "voxelize, resolution: 128", fmt::format("mutual_visibility, x: {}, y: {}", x, y)}),
        kSide, kSide, 1, [](Registry& registry) { addRegistered(registry, "docs/examples/mutual_visibility/"); });
    const ImageF seen = chain.image("seen");
    const glm::vec4 from =
        chain.readImage<glm::vec4>(chain.graph().resource<GBuffer>("gbuffer")->position)[y * kSide + x];
    ASSERT_GT(from.w, 0.0f);
    ASSERT_NEAR(from.y, 0, 1e-4);

    // A point light there lights what the pixel sees.
    auto lit = std::make_shared<SceneState>(chain.state());
    lit->lights[0].position = glm::vec3(from) + glm::vec3(0, 1e-3f, 0);
    Chain exact(lit, graphYaml({"gbuffer", "direct_shadow_rays"}), kSide, kSide, 1);
    const ImageF direct = exact.image("direct");

    size_t visible = 0, hidden = 0, wronglyHidden = 0, wronglySeen = 0;
    for (size_t pixel = 0; pixel < size_t(kSide) * kSide; ++pixel) {
        const bool isLit = direct.data[3 * pixel] > 0;
        ++(isLit ? visible : hidden);
        wronglyHidden += isLit && seen.data[3 * pixel] == 0;
        wronglySeen += !isLit && seen.data[3 * pixel] == 1;
    }
    std::printf("%zu pixels are seen, %zu are not; by voxels %zu less and %zu more\n", visible, hidden, wronglyHidden,
                wronglySeen);
    EXPECT_GT(visible, 3000u);
    EXPECT_GT(hidden, 500u);
    EXPECT_LT(double(wronglyHidden), 0.1 * double(visible));
    EXPECT_LT(double(wronglySeen), 0.02 * double(hidden));
    EXPECT_GT(chain.frameSamples.back().voxelSteps, 0u);
}

}  // namespace
}  // namespace voxray::test

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/gpu/chain.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace voxray {
namespace {

const std::string kView = R"(
- {pass: gbuffer}
- {pass: voxelize, resolution: 16}
- {pass: inject_light_rays, rays_per_light: 65536, bounces: 2}
- {pass: direct_shadow_rays}
- {pass: gather_irradiance}
)";

std::string messageOf(const std::string& graph) {
    return errorOf([&] { test::Chain chain("cornell", "", graph, 8, 8); });
}

TEST(Glsl, WritesWhatItsFunctionReturns) {
    test::Chain chain("cornell", "", R"(
- {pass: gbuffer}
- pass: glsl
  values: [0.5, 0.25, 2]
  source: |
    vec3 shade(ivec2 pixel, ivec2 texel) {
        return vec3(pixel, 1.0) * kernel.values;
    }
)",
                      13, 9);
    const ImageF image = chain.image("final");
    for (uint32_t y = 0; y < 9; ++y)
        for (uint32_t x = 0; x < 13; ++x) {
            const float* pixel = &image.data[3 * (y * 13 + x)];
            EXPECT_EQ(pixel[0], 0.5f * float(x));
            EXPECT_EQ(pixel[1], 0.25f * float(y));
            EXPECT_EQ(pixel[2], 2.0f);
        }
}

TEST(Glsl, AveragesTheTexelsOfAPixel) {
    test::Chain chain("cornell", "", R"(
- {pass: gbuffer, samples_per_pixel_edge: 3}
- {pass: glsl, source: "vec3 shade(ivec2 pixel, ivec2 texel) { return vec3(texel, kernel.samples); }"}
)",
                      4, 4);
    const ImageF image = chain.image("final");
    for (uint32_t p = 0; p < 16; ++p) {
        EXPECT_NEAR(image.data[3 * p], 3 * float(p % 4) + 1, 1e-5f);
        EXPECT_NEAR(image.data[3 * p + 1], 3 * float(p / 4) + 1, 1e-5f);
        EXPECT_EQ(image.data[3 * p + 2], 3);
    }
}

/// The example of docs/writing-a-pass.md is gather_irradiance, of either light.
TEST(Glsl, LooksLightUpInVoxels) {
    const std::string example = (test::sourceRoot() / "docs/examples/glsl/lookup.glsl").string();
    for (const std::string light : {"indirect", "direct"}) {
        test::Chain chain("cornell", "",
                          kView + R"(
- {pass: gather_irradiance, id: direct_lookup, light: direct}
- {pass: glsl, file: )" + example +
                              ", light: " + light + "}\n");
        const ImageF expected = chain.image(light), image = chain.image("final");
        double sum = 0;
        for (size_t i = 0; i < image.data.size(); ++i) {
            sum += double(expected.data[i]);
            EXPECT_FLOAT_EQ(image.data[i], expected.data[i]) << i;
        }
        EXPECT_GT(sum, 0);
    }
}

/// Means over 3 x 3 pixels, with edges repeated, of the image before it, whose name it writes.
TEST(Glsl, FiltersTheImageBeforeIt) {
    const std::string filter = R"(
- pass: glsl
  id: blur
  writes: indirect
  source: |
    vec3 shade(ivec2 pixel, ivec2 texel) {
        vec3 sum = vec3(0.0);
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) sum += texelOf(indirectImage, pixel + ivec2(i, j)).rgb;
        return sum / 9.0;
    }
)";
    test::Chain plain("cornell", "", kView), filtered("cornell", "", kView + filter + "- {pass: composite}");
    const ImageF before = plain.image("indirect"), after = filtered.image("indirect");
    const int width = int(before.width), height = int(before.height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const int cx = std::clamp(x + i, 0, width - 1), cy = std::clamp(y + j, 0, height - 1);
                    sum += double(before.data[size_t(3 * (cy * width + cx))]);
                }
            const double value = double(after.data[size_t(3 * (y * width + x))]);
            EXPECT_NEAR(value, sum / 9, 1e-5 * std::max(1.0, sum)) << x << ' ' << y;
        }
}

TEST(Glsl, ReadsAFileAndItsIncludes) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "two.glsl") << "const float kTwo = 2.0;\n";
    std::ofstream(folder / "own.glsl") << "#include \"two.glsl\"\n"
                                          "vec3 shade(ivec2 pixel, ivec2 texel) { return vec3(kTwo); }\n";
    const std::string graph = "- {pass: gbuffer}\n- {pass: glsl, file: " + (folder / "own.glsl").string() + "}\n";
    test::Chain chain("cornell", "", graph, 4, 4);
    EXPECT_EQ(chain.image("final").data.front(), 2.0f);
}

TEST(Glsl, TellsMistakesWithTheirLine) {
    const std::string gbuffer = "- {pass: gbuffer}\n";
    const std::string undeclared = R"(- pass: glsl
  source: |
    vec3 shade(ivec2 pixel, ivec2 texel) {
        return vec3(nothing);
    }
)";
    EXPECT_CONTAINS(messageOf(gbuffer + undeclared), "source:2: 'nothing' : undeclared identifier");
    EXPECT_CONTAINS(messageOf(gbuffer + "- {pass: glsl}\n"), "give either a 'source'");
    const std::string lacks = "'int one() { return 1; }'}\n";
    EXPECT_CONTAINS(messageOf(gbuffer + "- {pass: glsl, source: " + lacks), "defines no vec3 shade");
    const std::string other = "'vec3 shade(vec2 at) { return vec3(at, 0); } // vec3 shade(ivec2 p, ivec2 t) {'}\n";
    EXPECT_CONTAINS(messageOf(gbuffer + "- {pass: glsl, source: " + other), "defines 'vec3 shade(vec2 at)'");
    const std::string reads = "'vec3 shade(ivec2 pixel, ivec2 texel) { return texelOf(indirectImage, pixel).rgb; }'}\n";
    EXPECT_CONTAINS(messageOf(gbuffer + "- {pass: glsl, source: " + reads), "no pass before it writes 'indirect'");
    EXPECT_CONTAINS(messageOf(gbuffer + "- {pass: glsl, file: nowhere.glsl}\n"), "no file 'nowhere.glsl'");
}

TEST(Glsl, IsCheckedForNumbersThatAreNotFinite) {
    const std::string divides = "'vec3 shade(ivec2 pixel, ivec2 texel) { return vec3(1.0 / float(pixel.x)); }'}\n";
    EXPECT_CONTAINS(messageOf("- {pass: gbuffer}\n- {pass: glsl, source: " + divides), "glsl");
}

}  // namespace
}  // namespace voxray

// Rays of mirrors: closed forms of facing mirrors and furnaces, lamps and environment, the reference, the
// hand-over to cones.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/physics/mirror_scene.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

TEST(GatherMirror, ShowsALampAsDirectLight) {
    Material lamp = metal(glm::vec3(0.0f), 1.0f);
    lamp.metallic = lamp.specular = 0.0f;
    lamp.emission = {5, 3, 2};
    Chain chain(facing(metal({0.9f, 0.5f, 0.2f}), lamp), mirrorGraph("bounces: 4"), 8, 8);
    EXPECT_NEAR(centerOf(chain.image("direct"), 0), 0.9 * 5, 4.5e-3);
    EXPECT_NEAR(centerOf(chain.image("direct"), 1), 0.5 * 3, 1.5e-3);
    EXPECT_NEAR(centerOf(chain.image("direct"), 2), 0.2 * 2, 4e-4);
    EXPECT_EQ(mean(chain.image("indirect")), 0.0);
}

TEST(GatherMirror, ShowsTheEnvironmentAsDirectLight) {
    SceneBuilder b("sky");
    b.quad("mirror", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.material(metal(glm::vec3(0.8f))));
    b.camera({0, 0, 2}, {0, 0, 0}, 0.5f);
    b.scene().environment.radiance = {1, 2, 3};
    Chain chain(evaluated(b), mirrorGraph("bounces: 1"), 8, 8);
    for (size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(centerOf(chain.image("direct"), channel), 0.8 * double(channel + 1), 2e-3);
    EXPECT_EQ(mean(chain.image("indirect")), 0.0);
}

TEST(GatherMirror, FacingMirrorsAreAGeometricSeries) {
    // Both emit e and reflect r: e (1 + r + r² + ... + r^n), of which the first reflection is direct light.
    const double e = 2, r = 0.7;
    Material mirror = metal(glm::vec3(float(r)));
    mirror.emission = glm::vec3(float(e));
    for (const int n : {1, 2, 7}) {
        Chain chain(facing(mirror, mirror), mirrorGraph("bounces: " + std::to_string(n)), 8, 8);
        const double series = e * r * r * (1 - std::pow(r, n - 1)) / (1 - r);
        EXPECT_NEAR(centerOf(chain.image("direct")), e * r, 1e-3 * e) << n;
        EXPECT_NEAR(centerOf(chain.image("indirect")), series, 1e-3 * e) << n;
        EXPECT_NEAR(centerOf(chain.image("final")), e + e * r + series, 1e-3 * e) << n;
    }
}

/// A closed box that emits 1, all of metal.
State metalFurnace(float roughness) {
    return withMaterials("furnace", "{shape: box, albedo: 1, emission: 1}",
                         [&](Material& m) { m.metallic = 1, m.roughness = roughness; });
}

TEST(GatherMirror, KeepsTheEnergyOfAFurnaceOfMirrors) {
    // White metal loses nothing, at any angle: 1 more from each reflection. Half floats of the g-buffer keep
    // 2^-11.
    Chain chain(metalFurnace(0), mirrorGraph("bounces: 5"), 16, 16);
    const ImageF direct = chain.image("direct"), indirect = chain.image("indirect");
    for (const float value : direct.data) EXPECT_NEAR(value, 1.0f, 6e-4f);
    for (const float value : indirect.data) EXPECT_NEAR(value, 4.0f, 24e-4f);
}

TEST(GatherMirror, KeepsTheEnergyOfAFurnaceOfGlossyMetal) {
    // A glossy surface's light straight from lamps is another pass's: the reference's indirect light alone.
    for (const float roughness : {0.1f, 0.5f}) {
        const State state = metalFurnace(roughness);
        Chain reference(state, graphYaml({"path_trace, spp: 256, bounces: 2"}), 16, 16);
        Chain chain(state, mirrorGraph("max_roughness: 1, rays: 32, bounces: 3"), 16, 16);
        EXPECT_EQ(mean(chain.image("direct")), 0.0);
        EXPECT_NEAR(mean(chain.image("indirect")) / mean(reference.image("indirect")), 1.0, 0.005) << roughness;
    }
}

TEST(GatherMirror, ConvergesToTheReference) {
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}));
    const ImageF expected = pathTraced(state, 256, 1);
    const auto error = [&](const std::string& direct, const std::string& voxels) {
        Chain chain(state, roomGraph("direct_at_hits: " + direct, {}, voxels), 32, 32);
        const auto [difference, ratio] = errorAt(chain, "indirect", expected, -0.999f);
        std::printf("%s, %s: %.4f, ratio %.4f\n", direct.c_str(), voxels.c_str(), difference, ratio);
        EXPECT_NEAR(ratio, 1.0, 0.03) << direct;
        return difference;
    };
    // One bounce: exact with shadow rays, however coarse voxels are, but for edges within a pixel.
    EXPECT_LT(error("shadow_rays", "8"), 0.02);
    const double coarse = error("voxels", "8"), fine = error("voxels", "32");
    EXPECT_LT(fine, 0.03);
    EXPECT_LT(fine, 0.6 * coarse);
}

TEST(GatherMirror, LightThatMirrorsThrowIsInTheVoxels) {
    // What a mirror sends on to the walls, but for what comes to it straight from the point light: the
    // reference finds no such path.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}));
    Chain reference(state, graphYaml({"path_trace, spp: 512, bounces: 3"}), 32, 32);
    const auto wallsOf = [](Chain& chain, const ImageF& image) {
        const auto positions = chain.readImage<glm::vec4>(chain.get<GBuffer>("gbuffer").position);
        double sum = 0;
        for (size_t i = 0; i < positions.size(); ++i)
            if (positions[i].z > -0.99f) sum += image.data[3 * i];
        return sum;
    };
    const auto ratio = [&](const std::string& secondary) {
        Chain chain(
            state,
            graphYaml({"gbuffer", "voxelize, resolution: 32",
                       "inject_light_rays, rays_per_light: 262144, bounces: 3, " + secondary, "gather_irradiance"}),
            32, 32);
        return wallsOf(chain, chain.image("indirect")) / wallsOf(chain, reference.image("indirect"));
    };
    const double with = ratio("secondary: material, caustics: false"), without = ratio("secondary: diffuse");
    std::printf("mean ratio %.4f, without mirrors %.4f\n", with, without);
    EXPECT_NEAR(with, 1.0, 0.04);
    EXPECT_LT(without, 0.9);
}

TEST(GatherMirror, ShowsTheBuiltInMirrorsAsTheReferenceDoes) {
    // A lamp's light on what a wall of mirror shows; spheres in the sun over a floor of mirror. What a mirror
    // shows of a lamp is direct light, and has a closed form above.
    struct View {
        const char *scene, *parameters;
        float depth;  ///< As errorAt() takes it: the wall, and all.
    };
    for (const View& view : {View{"mirror_room", "{count: 3}", -1.999f}, View{"mirror_row", "{count: 3}", 1e9f}}) {
        const ImageF& reference = pathTraced(view.scene, view.parameters, 256, 1);
        Chain chain(view.scene, view.parameters,
                    graphYaml({"gbuffer, samples_per_pixel_edge: 4", "voxelize, resolution: 16",
                               "inject_light_rays, bounces: 0", "gather_mirror, bounces: 1, light_samples: 4"}));
        const auto [difference, ratio] = errorAt(chain, "indirect", reference, view.depth);
        std::printf("%s: %.4f, ratio %.4f\n", view.scene, difference, ratio);
        EXPECT_NEAR(ratio, 1.0, 0.02) << view.scene;
        EXPECT_LT(difference, 0.03) << view.scene;
    }
}

/// wallRoom with a lamp behind the camera in place of the point light.
State lampRoom(const Material& wall) {
    SceneBuilder b("lamp");
    const uint32_t white = b.lambert("white", glm::vec3(0.7f)), red = b.lambert("red", {0.7f, 0.2f, 0.1f});
    b.room({-1, 0, -1}, {1, 2, 1}, {red, white, white, white, b.material(wall), white});
    b.box("box", {0.3f, 0, 0}, {0.5f, 0.7f, 0.5f}, 0.3f, red);
    b.quad("lamp", {-0.9f, 1.3f, 0.99f}, {0, 0.6f, 0}, {1.8f, 0, 0}, b.lambert("lamp", glm::vec3(0.7f), {10, 8, 5}));
    b.camera({-0.2f, 1, 0.9f}, {0, 0.9f, -1}, 70);
    return evaluated(b);
}

/// What the built-in mirror shows of the lamp at the ceiling, from near.
State lampInMirrorRoom() {
    auto state = builtin("mirror_room", "{count: 3}");
    SceneBuilder b("view");
    b.camera({0, 1.2f, 1.9f}, {0, 2.49f, -4}, 12);
    state->cameras = evaluate(b.finish(), 0.0).cameras;
    return state;
}

TEST(GatherMirror, DirectAndFinalLightAreTheReferences) {
    // Who brings what (docs/mirrors.md): a lamp in a perfect mirror, and on a glossy wall, is direct light.
    // No lamp is in the camera's view.
    struct View {
        const char* name;
        State state;
        float wall;  ///< Surfaces at a lower z are the mirror.
        std::string mirror;
    };
    const glm::vec3 gold(0.9f, 0.8f, 0.6f);
    for (const View& view : {View{"mirror_room", lampInMirrorRoom(), -1.999f, "rays: 1"},
                             View{"mirror", lampRoom(metal(gold)), -0.999f, "rays: 1"},
                             View{"glossy", lampRoom(metal(gold, 0.3f)), -0.999f, "max_roughness: 1, rays: 4"}}) {
        Chain reference(view.state, graphYaml({"path_trace, spp: 1024, bounces: 1"}), 32, 32);
        Chain chain(view.state,
                    graphYaml({"gbuffer, samples_per_pixel_edge: 8", "voxelize, resolution: 16",
                               "inject_light_rays, bounces: 0", "direct_shadow_rays, light_samples: 16",
                               "gather_mirror, bounces: 1, light_samples: 16, " + view.mirror, "composite"}),
                    32, 32);
        const ImageF whole = reference.image("final"), indirect = reference.image("indirect");
        ImageF direct = whole;
        for (size_t i = 0; i < direct.data.size(); ++i) direct.data[i] -= indirect.data[i];
        const auto check = [&](const char* port, const ImageF& expected, float depth, double noise) {
            const auto [difference, ratio] = errorAt(chain, port, expected, depth);
            std::printf("%s, %s up to %g: %.4f, ratio %.4f\n", view.name, port, double(depth), difference, ratio);
            EXPECT_NEAR(ratio, 1.0, 0.02) << view.name << " " << port;
            EXPECT_LT(difference, noise) << view.name << " " << port;
        };
        check("direct", direct, view.wall, 0.05);
        check("direct", direct, 1e9f, 0.05);
        check("indirect", indirect, view.wall, 0.1);  // Walls next to the lamp are noisy in both.
        check("final", whole, view.wall, 0.05);
    }
}

TEST(GatherMirror, VarnishTakesFromTheDiffuseLobe) {
    // A mirror over a red wall: what the mirror reflects is missing below it.
    Material varnish = metal({0.8f, 0.2f, 0.1f});
    varnish.metallic = 0;
    varnish.ior = 2.5f;
    const State state = wallRoom(varnish);
    const ImageF reference = pathTraced(state, 1024, 1);
    Chain chain(state,
                roomGraph("bounces: 1", {"trace_gather_rays, rays_per_block: 64",
                                         "gather_rays, direct_at_hits: shadow_rays, near_field_cells: 0"}),
                32, 32);
    const auto [difference, ratio] = errorAt(chain, "indirect", reference, -0.999f);
    std::printf("%.4f, ratio %.4f\n", difference, ratio);
    EXPECT_NEAR(ratio, 1.0, 0.01);
    EXPECT_LT(difference, 0.04);
}

TEST(GatherMirror, HandsOverToCones) {
    // Cones alone, both, rays alone: the same lobe, whoever brings which part of it.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}, 0.4f));
    const ImageF expected = pathTraced(state, 512, 1);
    const std::vector<std::string> cones{"filter_voxels",
                                         "gather_cones, visibility: voxels, cones: 5, stride: 16, specular: 19"};
    for (const std::string range :
         {"max_roughness: 0.1, blend_roughness: 0.1", "max_roughness: 0.3, blend_roughness: 0.2",
          "max_roughness: 0.4, blend_roughness: 0.2"}) {
        Chain chain(state, roomGraph(range + ", rays: 16", cones, "64"), 32, 32);
        const auto [difference, ratio] = errorAt(chain, "indirect", expected, -0.999f);
        std::printf("%s: %.4f, ratio %.4f\n", range.c_str(), difference, ratio);
        EXPECT_NEAR(ratio, 1.0, 0.03) << range;
        EXPECT_LT(difference, 0.12) << range;
    }
}

TEST(GatherMirror, LeavesConesAsTheyAreWithoutMirrors) {
    // Nothing is left to rays: what gather_cones shows by itself.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}, 0.4f));
    const std::vector<std::string> cones{"filter_voxels",
                                         "gather_cones, visibility: voxels, cones: 5, stride: 16, specular: 7"};
    Chain both(state, roomGraph("max_roughness: 0, blend_roughness: 0", cones), 16, 16);
    std::vector<std::string> alone{"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 32",
                                   "inject_light_rays, rays_per_light: 524288, bounces: 0"};
    alone.insert(alone.end(), cones.begin(), cones.end());
    Chain one(state, graphYaml(alone), 16, 16);
    const ImageF joined = both.image("indirect"), expected = one.image("indirect");
    for (size_t i = 0; i < joined.data.size(); ++i)
        EXPECT_NEAR(joined.data[i], expected.data[i], 1e-5f + 1e-4f * expected.data[i]);
}

TEST(GatherMirror, IsLinearInLightAndDeterministic) {
    const auto image = [](float intensity) {
        Chain chain(wallRoom(metal(glm::vec3(0.9f), 0.15f), intensity),
                    roomGraph("max_roughness: 0.2, rays: 2, bounces: 2"), 16, 16);
        return chain.image("indirect");
    };
    const ImageF one = image(1), seven = image(7);
    EXPECT_NEAR(mean(seven) / mean(one), 7.0, 7e-3);
    EXPECT_EQ(image(1).data, one.data);
}

TEST(GatherMirror, RefusesConesThatBringLamps) {
    EXPECT_ERROR("'emission' of filter_voxels",
                 Chain("mirror_room", "{}",
                       roomGraph("bounces: 1", {"filter_voxels, emission: true", "gather_cones, visibility: voxels"})));
}

}  // namespace
}  // namespace voxray::test

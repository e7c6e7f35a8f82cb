// Gathers whose rays hit perfect mirrors: light that mirrors reflect onto what the camera sees.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/view/gbuffer.h"
#include "tests/physics/mirror_scene.h"

namespace voxray::test {
namespace {

const std::string kRays = "gather_rays", kCones = "gather_cones, near_field_voxels: 2";

std::string gatherGraph(const std::string& gather, const std::string& inject, const std::string& resolution) {
    return graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: " + resolution,
                      "inject_light_rays, " + inject, "filter_voxels, layout: svo",
                      "trace_gather_rays, rays_per_block: 1024, block: 2", gather});
}

/// A floor of albedo 0.5 at the foot of a wall, seen from above.
State footOfAWall(const Material& wall, float environment, float lamp) {
    SceneBuilder b("foot");
    b.quad("floor", {0, 0, 1}, {1, 0, 0}, {0, 0, -2}, b.lambert("floor", glm::vec3(0.5f)));
    b.quad("wall", {-0.01f, -0.01f, 40}, {0, 0, -80}, {0, 40, 0}, b.material(wall));
    if (lamp > 0)  // Far above, with its face down
        b.quad("lamp", {-400, 41, -400}, {800, 0, 0}, {0, 0, 800}, b.lambert("lamp", glm::vec3(0), glm::vec3(lamp)));
    b.scene().environment.radiance = glm::vec3(environment);
    b.camera({0.3f, 1, 0}, {0.05f, 0, 0}, 1);
    return evaluated(b);
}

TEST(GatherAtMirrors, AWallOfMirrorReflectsHalfOfTheSky) {
    // A wall, nearly infinite, covers half of the cosine-weighted hemisphere, and shows the sky or a lamp there. White
    // metal reflects all light at any angle.
    const double expected = 0.5 * 0.5;
    for (const std::string& gather : {kRays, kCones})
        for (const bool isLamp : {false, true}) {
            const State state = footOfAWall(metal(glm::vec3(1)), isLamp ? 0.0f : 1.0f, isLamp ? 1.0f : 0.0f);
            Chain chain(state, gatherGraph(gather, "rays_per_light: 1024, bounces: 0", "32"), 8, 8);
            const double found = mean(chain.image("indirect"));
            std::printf("%s, %s: %.4f of the closed form\n", gather.c_str(), isLamp ? "lamp" : "sky", found / expected);
            EXPECT_NEAR(found / expected, 1, 0.03) << gather << (isLamp ? ", lamp" : ", sky");
        }
}

TEST(GatherAtMirrors, SurfacesThatAreNoPerfectMirrorsReflectNothingSo) {
    for (const std::string& gather : {kRays, kCones}) {
        Chain chain(footOfAWall(metal(glm::vec3(1), 0.3f), 1, 0),
                    gatherGraph(gather, "rays_per_light: 1024, bounces: 0", "32"), 8, 8);
        EXPECT_EQ(mean(chain.image("indirect")), 0) << gather;
    }
}

TEST(GatherAtMirrors, WallsBeforeAMirrorAreAsBrightAsTheReferences) {
    const std::string scene = "mirror_room", parameters = "{count: 3}";
    const ImageF& reference = pathTraced(scene, parameters, 512, 4);
    for (const std::string& gather : {kRays, kCones}) {
        Chain chain(scene, parameters,
                    gatherGraph(gather, "rays_per_light: 524288, bounces: 3, secondary: material", "32"));
        const ImageF image = chain.image("indirect");
        const auto positions = chain.readImage<glm::vec4>(chain.get<GBuffer>("gbuffer").position);
        double own = 0, theirs = 0;
        for (size_t pixel = 0; pixel < size_t(image.width) * image.height; ++pixel) {
            const size_t texel = 2 * (pixel / image.width * 2 * image.width + pixel % image.width);
            for (size_t c = 3 * pixel; positions[texel].z > -1.9f && c < 3 * pixel + 3; ++c) {
                own += image.data[c];
                theirs += reference.data[c];
            }
        }
        std::printf("%s: %.4f of the reference\n", gather.c_str(), own / theirs);
        EXPECT_NEAR(own / theirs, 1, 0.03) << gather;
    }
}

}  // namespace
}  // namespace voxray::test

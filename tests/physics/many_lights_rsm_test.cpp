// Virtual point lights out of reflective shadow maps: their flux, how they move, and what has no such map.
#include <gtest/gtest.h>

#include "tests/physics/many_lights.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string rsmLights(const std::string& rsm, const std::string& sample) {
    return graphYaml({"gbuffer", "voxelize", "render_rsm" + rsm, "sample_vpls, first: rsm, " + sample,
                      "gather_vpls, visibility: exact, bound: 0"});
}

TEST(ManyLights, OfReflectiveShadowMapsCarryEqualPartsOfAllFlux) {
    // Half of 8 pi W is reflected. Parts are equal but for the rounding of weights to whole numbers
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                rsmLights(", rsm_resolution: 256", "vpls_per_bounce: 4096, bounces: 1"), 4, 4);
    const auto points = chain.read<gpu::Vpl>(vpls(chain).points);
    ASSERT_EQ(vpls(chain).activeCount, 4096u);
    for (const gpu::Vpl& vpl : points) ASSERT_NEAR(vpl.flux.y * 4096 / (4 * kPi), 1, 2e-3);
}

TEST(ManyLights, OfReflectiveShadowMapsBringTheLightOfLightRays) {
    for (const std::string parameters : {"{lights: point}", "{lights: spot}", "{lights: sun}"}) {
        const double rays =
            meanIndirect("cornell", parameters,
                         manyLights("vpls_per_bounce: 16384", "visibility: exact, bound: 0, block: 1"), 16, 16);
        const double map = meanIndirect(
            "cornell", parameters,
            graphYaml({"gbuffer", "voxelize", "render_rsm", "sample_vpls, first: rsm, vpls_per_bounce: 16384",
                       "gather_vpls, visibility: exact, bound: 0, block: 1"}),
            16, 16);
        EXPECT_NEAR(map / rays, 1, 0.02) << parameters;
    }
}

TEST(ManyLights, OfReflectiveShadowMapsAllFallOnTheOnlyTexelThatSeesAnything) {
    // A square of 20 cm, 1 m below a spot: of nine texels the center sees it, with (2/3)² sr. More paths than
    // texels
    SceneState state = *builtin("plane", "{light: spot}");
    Light& spot = state.lights.at(0);
    spot.outerConeAngle = float(kPi / 4), spot.innerConeAngle = spot.outerConeAngle - 0.01f;
    for (glm::vec3& position : state.geometry.positions) position *= 0.02f;
    state.geometry.boundsMin *= 0.02f, state.geometry.boundsMax *= 0.02f;
    Chain chain(state, rsmLights(", rsm_resolution: 3", "vpls_per_bounce: 64, bounces: 1"), 4, 4);
    ASSERT_EQ(vpls(chain).activeCount, 64u);
    double flux = 0;
    for (const gpu::Vpl& vpl : chain.read<gpu::Vpl>(vpls(chain).points)) {
        flux += vpl.flux.y;
        EXPECT_LT(glm::length(vpl.position), 1e-4f);
    }
    EXPECT_NEAR(flux / (0.5 * 4.0 / 9), 1, 1e-4);
}

TEST(ManyLights, OfReflectiveShadowMapsMoveWithTheLight) {
    // A light that moves by a millimetre moves its virtual lights by little more
    const auto positions = [](float x) {
        SceneState state = *builtin("white_room");
        state.lights.at(0).position.x = x;
        Chain chain(state, rsmLights("", "vpls_per_bounce: 1024, bounces: 1"), 4, 4);
        return chain.read<gpu::Vpl>(vpls(chain).points);
    };
    const std::vector<gpu::Vpl> before = positions(0.1f), after = positions(0.101f);
    size_t far = 0;
    for (size_t i = 0; i < before.size(); ++i) far += glm::distance(before[i].position, after[i].position) > 0.03f;
    std::printf("%zu of %zu virtual lights moved by more than 3 cm\n", far, before.size());
    EXPECT_LT(double(far), 0.02 * double(before.size()));
}

TEST(ManyLights, OfMoreReflectiveShadowMapsThanShadersCanIndexAreRefused) {
    // Cubes of 43 point lights have 258 views of 2^24 texels
    const auto message = [](int lights) {
        SceneBuilder b("lights");
        b.quad("ground", {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, b.lambert("grey", glm::vec3(0.5f)));
        for (int i = 0; i < lights; ++i) b.pointLight({0, 1, 0.01f * float(i)}, glm::vec3(1));
        b.camera({0, 3, 3}, {0, 0, 0}, 60);
        return errorOf([&] { Chain(evaluated(b), graphYaml({"render_rsm, rsm_resolution: 4096"}), 4, 4); });
    };
    EXPECT_CONTAINS(message(43), "258 views of lights, 4096x4096 texels each, are more than 2^32 texels");
}

TEST(ManyLights, OfReflectiveShadowMapsNameWhatHasNoViewpointAndWhatIsBlack) {
    EXPECT_ERROR("'first: light_rays'", Chain("cornell", "{lights: area}", rsmLights("", "bounces: 1")));
    EXPECT_ERROR("none of 1024 rays", Chain("white_room", "{albedo: 0}", rsmLights("", "bounces: 1")));
}

}  // namespace
}  // namespace voxray::test

// A lamp of which an alpha mask cuts half away shines as one that never had that half, by every way that
// light takes.
#include "tests/physics/masked_lamp.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/gpu/chain.h"
#include "tests/support/injections.h"
#include "trace/emission.h"

namespace voxray::test {
namespace {

/// Mean of an image that a graph writes, over that of the twin that lacks the half.
void expectTwinsLight(const std::vector<std::string>& passes, const std::string& image, double tolerance) {
    const auto light = [&](CutBy cut) {
        Chain chain(roomWithHalfALamp(cut), graphYaml(passes), 24, 24);
        return mean(chain.image(image));
    };
    const double whole = light(CutBy::Nothing);
    ASSERT_GT(whole, 0);
    for (const CutBy cut : kCuts)
        EXPECT_NEAR(light(cut) / whole, 1, tolerance) << passes.back() << ", cut by " << nameOf(cut);
}

TEST(MaskedLamp, LightsDirectlyByWhatIsLeft) {
    expectTwinsLight({"gbuffer", "direct_shadow_rays, light_samples: 64"}, "direct", 0.01);
}

TEST(MaskedLamp, IsInjectedByWhatIsLeft) {
    for (const Injection& injection : kInjections) {
        if (!injection.takesEmission) continue;
        const bool fromLights = injection.pass.starts_with("inject_light_rays");
        expectTwinsLight({"gbuffer", "voxelize, resolution: 16", "place_surfels, points_per_voxel: 8", "link_surfels",
                          "trace_gather_rays, rays_per_block: 64",
                          injection.withBounces(1) + (fromLights ? "" : ", light_samples: 16"), "gather_rays"},
                         "indirect", 0.03);
    }
}

TEST(MaskedLamp, MakesVirtualLightsAndLightsSurfelsByWhatIsLeft) {
    expectTwinsLight({"gbuffer", "sample_vpls, vpls_per_bounce: 8192, bounces: 1", "gather_vpls, visibility: exact"},
                     "indirect", 0.03);
    expectTwinsLight({"gbuffer", "voxelize, resolution: 16", "place_surfels, points_per_voxel: 8",
                      "link_surfels, rays_per_surfel: 32", "inject_radiosity, bounces: 1", "gather_surfels"},
                     "indirect", 0.03);
}

TEST(MaskedLamp, IsWorthItsPart) {
    // Of two triangles with 4 W/(m² sr) each half is left; a triangle that is cut away whole is none to
    // sample.
    for (const CutBy cut : kCuts) {
        const auto state = roomWithHalfALamp(cut);
        double emitted = 0;
        size_t emitters = 0;
        for (uint32_t t = 0; t < state->geometry.triangles.size(); ++t) {
            emitted += double(meanEmission(*state, t).y);
            emitters += canEmit(*state, t);
        }
        EXPECT_NEAR(emitted, cut == CutBy::Factor ? 8 : 4, 0.05) << nameOf(cut);
        EXPECT_EQ(emitters, 2u) << nameOf(cut);
    }
}

}  // namespace
}  // namespace voxray::test

#include <gtest/gtest.h>

#include "passes/path_trace/integrator.h"
#include "tests/physics/masked_lamp.h"
#include "tests/physics/path_trace_scene.h"

namespace voxray::test {
namespace {

using path_trace::Strategy;

double light(CutBy cut, Strategy strategy, uint32_t spp) {
    const auto state = roomWithHalfALamp(cut);
    const PathTraceOptions options{.width = 24, .height = 24, .spp = spp, .bounces = 2};
    return meanOf(path_trace::render(*state, EmbreeScene(*state), state->cameras[0], options, {}, strategy).total);
}

TEST(PathTraceMaskedLamp, ShinesByWhatIsLeft) {
    // Found by chance alone, without any list of lights: what each way of sampling must come to.
    const double whole = light(CutBy::Nothing, Strategy::ReflectionOnly, 4096);
    for (const CutBy cut : kCuts)
        for (const Strategy strategy : {Strategy::Mis, Strategy::LightsOnly})
            EXPECT_NEAR(light(cut, strategy, 256) / whole, 1, 0.01)
                << nameOf(cut) << (strategy == Strategy::Mis ? ", MIS" : ", lights only");
}

}  // namespace
}  // namespace voxray::test

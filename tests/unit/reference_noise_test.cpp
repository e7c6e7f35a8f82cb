#include <gtest/gtest.h>

#include "config/config.h"
#include "experiment/reference.h"
#include "experiment/scene_setup.h"
#include "passes/path_trace/path_tracer.h"

/// That errors against a reference are free of its noise rests on its halves' independence of each other and
/// of what is compared with them.
namespace voxray {
namespace {

/// Correlation of the signs of x - otherX and y - otherY, images of one mean, pixel by pixel. Signs, because
/// a few bright paths would outweigh all others.
double correlation(const ImageF& x, const ImageF& otherX, const ImageF& y, const ImageF& otherY) {
    int sum = 0, count = 0;
    for (size_t i = 1; i < x.data.size(); i += 3) {
        const float a = x.data[i] - otherX.data[i], b = y.data[i] - otherY.data[i];
        if (a == 0 || b == 0) continue;
        sum += (a > 0) == (b > 0) ? 1 : -1;
        ++count;
    }
    return double(sum) / count;
}

TEST(ReferenceNoise, IsIndependentOfAPathTracedVariantOfTheSameSeedAndSamples) {
    const Experiment experiment =
        parseExperiment("name: noise\nscene: {builtin: cornell}\ngraph: [{pass: path_trace}]\n", "noise.yaml");
    SceneLoader loader({});
    const PreparedScene prepared = loader.prepare(experiment.setup.scene);
    const EmbreeScene tracer(prepared.state);
    const auto halvesOf = [&](uint64_t seed) {
        return pathTrace(prepared.state, tracer, prepared.camera,
                         {.width = 96, .height = 96, .spp = 2, .bounces = 2, .seed = seed})
            .totalHalves;
    };
    for (const uint64_t seed : {0u, 7u}) {
        const auto variant = halvesOf(seed), other = halvesOf(seed + 1000), reference = halvesOf(referenceSeed(seed));
        // 4 standard deviations. Where one image is the same, the signs agree in two of three pixels.
        const double limit = 4.0 / 96;
        EXPECT_NEAR(correlation(variant[0], other[0], variant[0], other[1]), 1.0 / 3, 2 * limit);
        for (const ImageF& half : variant) {
            EXPECT_NEAR(correlation(half, other[0], reference[0], reference[1]), 0, limit);
            EXPECT_NEAR(correlation(half, other[1], reference[0], reference[1]), 0, limit);
        }
        const auto third = halvesOf(referenceSeed(seed) + 1000);
        EXPECT_NEAR(correlation(reference[0], third[0], reference[1], third[1]), 0, limit);
    }
}

}  // namespace
}  // namespace voxray

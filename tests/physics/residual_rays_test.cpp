// Residual rays: the mean is the path tracer's, whatever light is stored.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gather_light.h"
#include "tests/gpu/mean_of_frames.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// Makes what gather rays found wrong by a factor.
class ScaleGatherLight final : public Pass {
 public:
    static constexpr const char* kName = "scale_gather_light";
    static constexpr const char* kHelp = "Scales what gather rays bring.";
    struct Params {
        float factor = 1;
        static constexpr auto schema() {
            return std::tuple{field("factor", &Params::factor, "Of radiance.", -10.0f, 10.0f)};
        }
    };
    explicit ScaleGatherLight(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        const GatherLight& from = plan[light_];
        GatherLight& to = plan[scaled_];
        to.light = std::vector<Buffer>(from.light.size());
        const GatherHits& hits = plan[hits_];
        for (uint32_t b = 0; b < to.light.size(); ++b)
            plan.buffer(to.light[b], "scaled light",
                        uint64_t(hits.batchBlocks(b)) * hits.layout.raysPerBlock * sizeof(glm::vec4));
    }
    void record(PassContext& context) override {
        const GatherLight &from = context[light_], &to = context[scaled_];
        for (size_t b = 0; b < to.light.size(); ++b) {
            auto values = context.stream.readAs<glm::vec4>(from.light[b], from.light[b].bytes() / sizeof(glm::vec4));
            for (glm::vec4& v : values) v = glm::vec4(params_.factor * glm::vec3(v), v.w);
            context.stream.upload(to.light[b], values);
        }
    }

 private:
    const Params params_;
    In<GatherHits> hits_{*this, "gather_hits", ""};
    In<GatherLight> light_{*this, "gather_light", ""};
    Out<GatherLight> scaled_{*this, "gather_light", ""};
};

void addScale(Registry& registry) {
    registry.add<ScaleGatherLight>();
}

std::string graphOf(const std::string& residual, float factor = 1, const std::string& trace = "rays_per_block: 1",
                    const std::vector<std::string>& after = {}) {
    std::vector<std::string> passes{"gbuffer, samples_per_pixel_edge: 8",
                                    "voxelize, resolution: 16",
                                    "inject_light_rays, rays_per_light: 65536, bounces: 2",
                                    "trace_gather_rays, " + trace,
                                    "gather_rays",
                                    "scale_gather_light, factor: " + std::to_string(factor),
                                    "residual_rays, " + residual};
    passes.insert(passes.end(), after.begin(), after.end());
    return graphYaml(passes);
}

double zOf(const Estimate& a, const Estimate& b) {
    return (a.mean - b.mean) / std::sqrt(a.variance + b.variance);
}

Estimate meanOfFrames(const State& state, const std::string& graph, int frames) {
    Chain chain(state, graph, 32, 32, 1, addScale);
    return meanOfFrames(chain, frames);
}

TEST(ResidualRays, KeepsTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.6. Stored light has two bounces in all, and a factor that is wrong.
    const double expected = 0.36 + 0.216 + 0.1296;
    for (const float factor : {0.0f, 2.0f}) {
        const Estimate found = meanOfFrames(builtin("furnace", "{shape: box, albedo: 0.6, emission: 1}"),
                                            graphOf("probability: 0.25, bounces: 3", factor), 4);
        std::printf("factor %.0f: %.4f of the closed form\n", double(factor), found.mean / expected);
        EXPECT_NEAR(found.mean / expected, 1, 0.01);
        EXPECT_LT(std::abs(zOf(found, {expected, 0})), 5);
    }
}

TEST(ResidualRays, MeanIsTheReferencesWhateverIsStored) {
    struct Case {
        const char *name, *parameters;
    };
    for (const Case& c : {Case{"cornell", "{lights: area}"}, Case{"window_room", "{slats: 0}"}}) {
        SCOPED_TRACE(c.name);
        const State state = builtin(c.name, c.parameters);
        const Estimate reference = meanOfFrames(state, graphYaml({"path_trace, spp: 512, bounces: 4"}), 16);
        const auto compare = [&](const std::string& parameters, float factor) {
            const Estimate found =
                meanOfFrames(state, graphOf("bounces: 4, " + parameters, factor, "rays_per_block: 1"), 24);
            const double ratio = found.mean / reference.mean,
                         error = std::sqrt(found.variance + reference.variance) / reference.mean;
            std::printf("%s, %s, stored light times %.0f: ratio %.4f +- %.4f, z %.1f\n", c.name, parameters.c_str(),
                        double(factor), ratio, error, zOf(found, reference));
            EXPECT_NEAR(ratio, 1, 0.005 + 2 * error);
            EXPECT_LT(std::abs(zOf(found, reference)), 4);
        };
        for (const float factor : {0.0f, 1.0f, 2.0f}) compare("probability: 0.3", factor);
        compare("probability: 1", 1);

        // The same comparison finds that stored light alone lacks bounces
        const Estimate stored =
            meanOfFrames(state,
                         graphYaml({"gbuffer, samples_per_pixel_edge: 8", "voxelize, resolution: 16",
                                    "inject_light_rays, rays_per_light: 65536, bounces: 2",
                                    "trace_gather_rays, rays_per_block: 1", "gather_rays"}),
                         4);
        EXPECT_GT(std::abs(stored.mean / reference.mean - 1), 0.02);
    }
}

TEST(ResidualRays, MeanIsTheReferencesOverACache) {
    const State state = builtin("cornell", "{lights: area}");
    const Estimate reference = meanOfFrames(state, graphYaml({"path_trace, spp: 512, bounces: 4"}), 8);
    const auto gathered = [&](const std::string& residual) {
        return meanOfFrames(
            state,
            graphYaml({"gbuffer, samples_per_pixel_edge: 8", "update_radiance_cache, rays_per_image: 4096, bounces: 1",
                       "trace_gather_rays, rays_per_block: 1",
                       "gather_rays, source: radiance_cache, near_field_cells: 0", residual}),
            16);
    };
    const Estimate stored = gathered(""), found = gathered("residual_rays, probability: 0.3, bounces: 4");
    std::printf("cache alone %.4f, with residuals %.4f, z %.1f\n", stored.mean / reference.mean,
                found.mean / reference.mean, zOf(found, reference));
    EXPECT_GT(std::abs(stored.mean / reference.mean - 1), 0.02);
    EXPECT_NEAR(found.mean / reference.mean, 1, 0.01);
    EXPECT_LT(std::abs(zOf(found, reference)), 4);
}

TEST(ResidualRays, GoOnWithTheirProbability) {
    const State state = builtin("cornell", "{lights: area}");
    const auto paths = [&](const std::string& parameters) {
        Chain chain(state, graphOf(parameters), 32, 32, 1, addScale);
        return reported(chain.frameSamples.back(), "paths, % of gather rays") / 100;
    };
    const double hits = paths("probability: 1");
    EXPECT_GT(hits, 0.5);
    for (const std::string p : {"0.1", "0.5"}) EXPECT_NEAR(paths("probability: " + p) / hits, std::stod(p), 0.01);
}

TEST(ResidualRays, AreDeterministic) {
    const State state = builtin("cornell", "{lights: area}");
    const auto image = [&] {
        return Chain(state, graphOf("probability: 0.3"), 32, 32, 1, addScale).image("indirect").data;
    };
    EXPECT_EQ(image(), image());
}

}  // namespace
}  // namespace voxray::test

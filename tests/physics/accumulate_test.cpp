// Irradiance added up over frames: what it must keep, where it must forget, and that it follows what moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/surface_motion.h"
#include "tests/gpu/chain.h"
#include "trace/embree_scene.h"

namespace voxray::test {
namespace {

/// A source of irradiance that knows how many frames it has had: 2 W/m² with noise.
class FrameIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "frame_irradiance";
    static constexpr const char* kHelp = "Irradiance that changes from frame to frame.";
    struct Params {
        float noise = 0;
        float step = 0;
        float scale = 1;
        uint32_t off = 1000;
        uint32_t spacing = 1;
        static constexpr auto schema() {
            return std::tuple{field("noise", &Params::noise, "Largest deviation over the mean.", 0.0f, 1.0f),
                              field("step", &Params::step, "Added in each frame.", 0.0f, 1e9f),
                              field("scale", &Params::scale, "Factor of all light.", 0.0f, 1e9f),
                              field("off", &Params::off, "The frame from which on it is dark."),
                              field("spacing", &Params::spacing, "One texel in spacing x spacing has rays.", 1u, 8u)};
        }
    };
    explicit FrameIrradiance(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override {
        NoisyIrradiance& noisy = plan[noisy_];
        noisy.spacing = params_.spacing;
        plan.image(noisy.irradiance, "known irradiance", NoisyIrradiance::desc(plan.frame, plan[gbuffer_].samples));
    }
    void record(PassContext& context) override {
        const Image& image = context[noisy_].irradiance;
        const glm::uvec3 texels = image.desc().extent;
        std::mt19937 random(1 + frame_);
        std::uniform_real_distribution<float> even(-1.0f, 1.0f);
        std::vector<glm::vec4> values(size_t(texels.x) * texels.y, glm::vec4(0.0f));
        const float level = frame_ < params_.off ? params_.scale * (2.0f + params_.step * float(frame_)) : 0.0f;
        for (uint32_t y = 0; y < texels.y; y += params_.spacing)
            for (uint32_t x = 0; x < texels.x; x += params_.spacing)
                values[size_t(y) * texels.x + x] =
                    glm::vec4(glm::vec3(level * (1.0f + params_.noise * even(random))), 1.0f);
        context.stream.upload(image, std::as_bytes(std::span(values)));
        ++frame_;
    }

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "for its size"};
    Out<NoisyIrradiance> noisy_{*this, "known_irradiance", "known irradiance"};
    uint32_t frame_ = 0;
};

constexpr uint32_t kSize = 48;

Chain chainOf(const State& state, const std::string& source, const std::string& settings,
              const std::string& gbuffer = "samples_per_pixel_edge: 1", uint32_t size = kSize) {
    return Chain(state,
                 "[{pass: gbuffer, " + gbuffer + "}, {pass: frame_irradiance, id: source, " + source +
                     "}, {pass: accumulate, inputs: {noisy_irradiance: source.known_irradiance}, " + settings + "}]",
                 size, size, 1, [](Registry& registry) { registry.add<FrameIrradiance>(); });
}

/// Irradiance and number of rays of all texels.
std::vector<glm::vec4> accumulated(Chain& chain) {
    return chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("noisy_irradiance").irradiance);
}
std::vector<glm::vec4> source(Chain& chain) {
    return chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("known_irradiance").irradiance);
}
std::vector<glm::vec4> previous(Chain& chain) {
    return chain.readImage<glm::vec4>(chain.get<SurfaceMotion>("motion").previous);
}

/// Variance of the first channel.
double variance(const std::vector<glm::vec4>& texels) {
    double sum = 0, squares = 0;
    for (const glm::vec4& t : texels) sum += t.r, squares += double(t.r) * t.r;
    const double mean = sum / double(texels.size());
    return squares / double(texels.size()) - mean * mean;
}

TEST(Accumulate, AStillCameraSeesTheMeanOfAllFrames) {
    Chain chain = chainOf(builtin("white_room"), "noise: 1", "history: 8, clamp: 0");
    std::vector<glm::dvec4> sums(kSize * kSize, glm::dvec4(0));
    double first = 0;
    for (int frame = 0; frame < 8; ++frame) {
        if (frame > 0) chain.runFrames(1);
        const auto texels = source(chain), mean = accumulated(chain);
        if (frame == 0) first = variance(mean);
        for (size_t i = 0; i < texels.size(); ++i) {
            sums[i] += texels[i];
            ASSERT_NEAR(mean[i].r, sums[i].r / (frame + 1), 1e-6 * 2) << frame;
            ASSERT_EQ(mean[i].a, float(frame + 1));
        }

        // 2304 texels: the variance of their variance is 4 / 5 of its square over their number
        EXPECT_NEAR(variance(mean) / first * (frame + 1), 1, 4 * std::sqrt(0.8 / (kSize * kSize)) * 2);
    }

    // From now on each frame counts as an eighth
    const auto before = accumulated(chain);
    chain.runFrames(1);
    const auto texels = source(chain), after = accumulated(chain);
    for (size_t i = 0; i < texels.size(); ++i) ASSERT_NEAR(after[i].r, before[i].r * 7 / 8 + texels[i].r / 8, 1e-6 * 2);
}

TEST(Accumulate, OneFrameOfHistoryChangesNothing) {
    Chain chain = chainOf(builtin("cornell"), "noise: 1", "history: 1", "samples_per_pixel_edge: 2");
    chain.runFrameFrom({0.1f, 1, 3});
    const auto texels = source(chain), same = accumulated(chain), surfaces = previous(chain);
    for (size_t i = 0; i < texels.size(); ++i) {
        if (surfaces[i].w == 0) continue;
        ASSERT_EQ(same[i], texels[i]);
    }
}

TEST(Accumulate, ConstantIrradianceStaysExactUnderAMovingCamera) {
    for (const char* gbuffer : {"method: rays, samples_per_pixel_edge: 2", "method: raster"})
        for (const char* clamp : {"clamp: 0", "clamp: 1"}) {
            Chain chain = chainOf(builtin("cornell"), "noise: 0", std::string("history: 16, ") + clamp, gbuffer);
            const glm::vec3 start = chain.state().cameras.at(0).position;
            for (int frame = 1; frame < 6; ++frame)
                chain.runFrameFrom(start + glm::vec3(0.03f, 0.01f, -0.02f) * float(frame));
            size_t old = 0, surfaces = 0;
            for (const glm::vec4& texel : accumulated(chain)) {
                if (texel.a == 0) continue;
                ASSERT_EQ(glm::vec3(texel), glm::vec3(2.0f));
                ++surfaces;
                old += texel.a == 6.0f;
            }
            EXPECT_GT(double(old), 0.6 * double(surfaces)) << gbuffer;
        }
}

TEST(Accumulate, FillsTexelsThatRaysMiss) {
    // The camera moves by its own texels' width and less, so that texels without a ray see where one was.
    Chain chain = chainOf(builtin("white_room"), "noise: 0, spacing: 2", "history: 16");
    const glm::vec3 start = chain.state().cameras.at(0).position;
    for (int frame = 1; frame < 8; ++frame) chain.runFrameFrom(start + glm::vec3(0.013f, 0.007f, 0) * float(frame));
    size_t filled = 0;
    for (const glm::vec4& texel : accumulated(chain)) {
        if (texel.a == 0) continue;
        ASSERT_EQ(glm::vec3(texel), glm::vec3(2.0f));
        ++filled;
    }
    EXPECT_GT(filled, kSize * kSize / 2);
}

TEST(Accumulate, ForgetsWhatTheCameraDidNotSee) {
    // Light of 2, then of 4: the mean where the point was seen, 4 where it was hidden. Lookups reach a texel
    // far, so that at an edge either is right.
    const auto state = builtin("cornell");
    constexpr uint32_t size = 4 * kSize;
    Chain chain = chainOf(state, "step: 2", "history: 16", "samples_per_pixel_edge: 1", size);
    const glm::vec3 from = state->cameras.at(0).position;
    chain.runFrameFrom(from + glm::vec3(0.5f, 0, 0));
    const auto texels = accumulated(chain), points = previous(chain);
    const auto motion = chain.readImage<glm::vec4>(chain.get<SurfaceMotion>("motion").motion);
    const EmbreeScene scene(*state);
    const auto isHidden = [&](size_t i) {
        const glm::vec3 away = glm::vec3(points[i]) - from;
        Ray ray{};
        ray.origin = from;
        ray.direction = glm::normalize(away);
        ray.tMin = 0;
        ray.tMax = glm::length(away) * 0.999f;
        return points[i].w > 0 && scene.occluded(ray);
    };
    std::vector<bool> hidden(texels.size());
    for (size_t i = 0; i < texels.size(); ++i) hidden[i] = isHidden(i);
    size_t inHiding = 0, forgotten = 0, inSight = 0, kept = 0;
    for (uint32_t y = 1; y + 1 < size; ++y)
        for (uint32_t x = 1; x + 1 < size; ++x) {
            const size_t i = size_t(y) * size + x;
            if (points[i].w == 0) continue;
            ASSERT_TRUE(texels[i].r == 3.0f || texels[i].r == 4.0f) << texels[i].r;
            uint32_t around = 0;
            for (int k = 0; k < 9; ++k) around += hidden[i + size_t(k / 3) * size + k % 3 - size - 1];
            const glm::vec2 place = glm::vec2(x, y) + glm::vec2(motion[i]);
            const bool inImage = glm::all(glm::greaterThanEqual(place, glm::vec2(1))) &&
                                 glm::all(glm::lessThan(place, glm::vec2(size - 2)));
            if (around == 9) ++inHiding, forgotten += texels[i].r == 4.0f;
            if (around == 0 && inImage) ++inSight, kept += texels[i].r == 3.0f;
        }
    EXPECT_GT(inHiding, 20u);
    EXPECT_EQ(forgotten, inHiding);
    EXPECT_GT(double(kept), 0.98 * double(inSight));
}

TEST(Accumulate, FollowsWhatMoves) {
    // Without the motion of spheres, which swing by more than a texel, these would be taken for other points.
    const auto state = builtin("spheres", "{count: 1, radius: 1.5}", Playback::Looping);
    Chain chain = chainOf(state, "step: 2", "history: 16, clamp: 0");
    const auto before = previous(chain);
    chain.goTo(0.15);
    const auto texels = accumulated(chain), points = previous(chain);
    const auto positions = chain.readImage<glm::vec4>(chain.get<GBuffer>("gbuffer").position);
    size_t moving = 0, kept = 0;
    double way = 0;
    for (size_t i = 0; i < texels.size(); ++i) {
        const float moved = glm::length(glm::vec3(points[i]) - glm::vec3(positions[i]));
        if (points[i].w == 0 || moved == 0) continue;
        ++moving;
        way = std::max(way, double(moved));
        kept += texels[i].r == 3.0f;
    }
    EXPECT_GT(moving, 60u);
    EXPECT_GT(way, 0.05);
    EXPECT_GT(double(kept), 0.8 * double(moving));
}

TEST(Accumulate, AClampedLightIsGoneAtOnce) {
    Chain clamped = chainOf(builtin("cornell"), "noise: 1, off: 4", "history: 8, clamp: 1");
    Chain free = chainOf(builtin("cornell"), "noise: 1, off: 4", "history: 8, clamp: 0");
    clamped.runFrames(3);
    free.runFrames(3);
    const double lit = mean(free.image("indirect"));
    EXPECT_NEAR(mean(clamped.image("indirect")) / lit, 1, 0.02);
    for (int frame = 1; frame < 12; ++frame) {
        clamped.runFrames(1);
        free.runFrames(1);
        EXPECT_EQ(mean(clamped.image("indirect")), 0) << frame;

        // 4 lit frames and `frame` dark ones; from 8 on each new one counts as an eighth
        const double left = frame <= 4 ? 4.0 / (4 + frame) : 0.5 * std::pow(7.0 / 8, frame - 4);
        EXPECT_NEAR(mean(free.image("indirect")) / lit, left, 1e-4) << frame;
    }
}

TEST(Accumulate, IsLinearInLight) {
    const auto run = [](const std::string& scale) {
        Chain chain = chainOf(builtin("cornell"), "noise: 1, scale: " + scale, "history: 8, clamp: 1");
        const glm::vec3 start = chain.state().cameras.at(0).position;
        for (int frame = 1; frame < 5; ++frame) chain.runFrameFrom(start + glm::vec3(0.02f, 0, 0) * float(frame));
        return accumulated(chain);
    };
    const auto one = run("1"), large = run("1048576"), small = run("9.5367431640625e-7");
    for (size_t i = 0; i < one.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            ASSERT_EQ(large[i][c], one[i][c] * 0x1p20f);
            ASSERT_EQ(small[i][c], one[i][c] * 0x1p-20f);
        }
}

TEST(Accumulate, LowersTheNoiseOfEveryGather) {
    const std::string light = "voxelize, resolution: 32", inject = "inject_light_rays, bounces: 1";
    const std::vector<std::vector<std::string>> gathers{
        {"path_trace, spp: 1, bounces: 1, light: indirect"},
        {light, inject, "trace_gather_rays, rays_per_block: 16, block: 4", "gather_rays"},
        {light, inject, "trace_gather_rays, rays_per_block: 16, block: 8", "gather_rays"}};
    for (const auto& gather : gathers)
        for (const bool isFiltered : {false, true}) {
            // Without the filter, texels of a frame that have no ray are black: at edges, a path that meets
            // the lamp
            const bool hasGaps = gather.size() == 1 || gather[2].ends_with("block: 8");
            if (hasGaps && !isFiltered) continue;
            const auto chainOfFrames = [&](int history) {
                std::vector<std::string> passes{"gbuffer"};
                passes.insert(passes.end(), gather.begin(), gather.end());
                passes.push_back("accumulate, history: " + std::to_string(history));
                if (isFiltered) passes.push_back("filter_irradiance");
                passes.insert(passes.end(), {"direct_shadow_rays", "composite"});
                return Chain("cornell", "{lights: area}", graphYaml(passes), 32, 32);
            };
            Chain single = chainOfFrames(1), chain = chainOfFrames(32);
            const ImageF one = single.image("indirect");
            double meanOfFrames = mean(one) / 32;
            for (int frame = 1; frame < 32; ++frame) {
                single.runFrame(uint32_t(frame));
                meanOfFrames += mean(single.image("indirect")) / 32;
            }
            chain.runFrames(31);
            const ImageF many = chain.image("indirect");
            const auto steps = [](const ImageF& image) {
                double sum = 0;
                for (size_t i = 3; i < image.data.size(); ++i)
                    sum += std::pow(double(image.data[i]) - image.data[i - 3], 2);
                return sum;
            };
            // The same rays; the filter weighs them by another noise.
            EXPECT_NEAR(mean(many) / meanOfFrames, 1, isFiltered ? 0.02 : 1e-4) << gather.back() << isFiltered;
            EXPECT_LT(steps(many), (isFiltered ? 0.8 : 0.25) * steps(one)) << gather.back() << isFiltered;
        }
}

TEST(Accumulate, HistoryOutlastsRaysThatAreBlack) {
    // The lamp goes off: what the filter is given is seven eighths of the mean of before, and rays that are all black
    for (const std::string estimator : {"mean", "regression"}) {
        Chain chain("white_room", "{}",
                    graphYaml({"gbuffer", "path_trace, spp: 4, bounces: 1, light: indirect", "accumulate, history: 8",
                               "filter_irradiance, estimator: " + estimator, "direct_shadow_rays", "composite"}),
                    32, 32);
        chain.runFrames(8);
        const double before = mean(chain.image("indirect"));
        chain.update([](SceneState& state) {
            state.lights[0].intensity = glm::vec3(0.0f);
            return std::vector<Box>{};
        });
        EXPECT_NEAR(mean(chain.image("indirect")) / before, 7.0 / 8, 0.02) << estimator;
    }
}

}  // namespace
}  // namespace voxray::test

#pragma once

#include <random>

#include "passes/common/filter/noisy_irradiance.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

/// A source of irradiance around 2 W/m² from so many rays a texel.
class KnownIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "known_irradiance";
    static constexpr const char* kHelp = "Irradiance around 2, with noise, from surfaces 10 m away.";
    struct Params {
        float noise = 0.0f;
        float rays = 1.0f;
        uint32_t spacing = 1;
        float scale = 1.0f;
        float slope = 0.0f;
        float step = 1.0f;
        uint32_t oneIn = 1;
        float firefly = 1.0f;
        float offset = 0.0f;
        bool moments = false;
        bool black = false;
        bool stratified = false;
        static constexpr auto schema() {
            return std::tuple{field("noise", &Params::noise, "Largest deviation over the mean.", 0.0f, 1.0f),
                              field("rays", &Params::rays, "Rays of a texel that has any.", 0.0f, 1e9f),
                              field("spacing", &Params::spacing, "One texel in spacing x spacing has rays.", 1u, 8u),
                              field("scale", &Params::scale, "Factor of all light.", -1e9f, 1e9f),
                              field("slope", &Params::slope, "Relative change over the image's width.", 0.0f, 1.0f),
                              field("step", &Params::step, "Factor of the right half.", 0.0f, 1e9f),
                              field("one_in", &Params::oneIn, "So many rays share what one brings.", 1u, 1000u),
                              field("firefly", &Params::firefly, "Factor of the texel in the middle.", 0.0f, 1e9f),
                              field("offset", &Params::offset, "Added to all light, W/m².", -1e9f, 1e9f),
                              field("moments", &Params::moments, "Whether the filter is told the moments of rays."),
                              field("black", &Params::black, "Whether moments are of rays that bring nothing."),
                              field("stratified", &Params::stratified, "Whether rays are noisy, but not their mean.")};
        }
    };
    explicit KnownIrradiance(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override {
        NoisyIrradiance& noisy = plan[noisy_];
        noisy.spacing = params_.spacing;
        noisy.blockSize = params_.moments ? 4 : 0;
        if (params_.moments)
            plan.buffer(noisy.moments, "known moments",
                        noisy.momentsBytes(gbufferExtent(plan.frame, plan[gbuffer_].samples)));
        plan.image(noisy.irradiance, "known irradiance", NoisyIrradiance::desc(plan.frame, plan[gbuffer_].samples));
    }
    void record(PassContext& context) override {
        const NoisyIrradiance& noisy = context[noisy_];
        const Image& image = noisy.irradiance;
        const glm::uvec3 texels = image.desc().extent;
        std::mt19937 random(1);
        std::uniform_real_distribution<float> even(-1.0f, 1.0f);
        std::vector<glm::vec4> values(size_t(texels.x) * texels.y, glm::vec4(0.0f));
        std::vector<gpu::RayMoments> moments;
        if (params_.moments) moments.resize(noisy.momentsBytes(texels) / sizeof(gpu::RayMoments));
        for (uint32_t y = 0; y < texels.y; y += params_.spacing)
            for (uint32_t x = 0; x < texels.x; x += params_.spacing) {
                const float at = (float(x) + 0.5f) / float(texels.x);
                const float mean =
                    2.0f * params_.scale * (1.0f + params_.slope * (at - 0.5f)) * (at < 0.5f ? 1.0f : params_.step);
                float light = mean * (1.0f + params_.noise * even(random));
                if (params_.oneIn > 1) light *= random() % params_.oneIn == 0 ? float(params_.oneIn) : 0.0f;
                if (x == texels.x / 2 && y == texels.y / 2) light *= params_.firefly;
                light += params_.offset;
                const float texel = params_.stratified ? mean + params_.offset : light;
                values[size_t(y) * texels.x + x] = glm::vec4(glm::vec3(texel), params_.rays);
                if (params_.moments)
                    add(moments[size_t(y / 4) * noisy.blocks(texels).x + x / 4], params_.black ? 0.0f : light,
                        params_.rays);
            }
        context.stream.upload(image, std::as_bytes(std::span(values)));
        if (params_.moments) context.stream.upload(noisy.moments, moments);
    }

 private:
    /// Adds a texel's rays to a block's: as if each brought the same.
    static void add(gpu::RayMoments& sum, float light, float rays) {
        sum.rays += rays;
        sum.luminance += rays * light;
        sum.squared += rays * light * light;
        sum.inverseDistance += rays / 10;
        sum.luminanceOverDistance += rays * light / 10;
        sum.squaredOverDistance += rays * light * light / 10;
    }

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "for its size"};
    Out<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "known irradiance"};
};

}  // namespace voxray::test

#pragma once

#include "passes/common/view/gbuffer.h"
#include "shaders/filter/ray_moments.h"
#include "shaders/filter/ray_statistics.h"

namespace voxray {

/// Irradiance estimated from few rays for each texel of the G-buffer: the input of filter_irradiance.
///
/// A gather writes `irradiance`; the rest is optional. From `moments` the filter derives statistics, the
/// variance of rays and bounds of irradiance gradients; without either it uses geometry and numbers of rays.
struct NoisyIrradiance : Resource {
    /// RGBA32F, of the G-buffer's extent (gbufferExtent). rgb: irradiance for the shading normal, W/m²: the
    /// mean over the texel's rays, each π times its radiance if rays are distributed by cosine. a: number of
    /// these rays; where it is 0, rgb is 0.
    Image irradiance;
    /// Every aligned square of `spacing` x `spacing` texels that shows a surface has a ray; 1: every texel
    /// has one. Known from plan() on.
    uint32_t spacing = 1;

    /// Texels along the edge of a block of `moments` or `statistics`; 0: neither. Known from plan() on. The
    /// filter adds up 3 x 3 blocks of moments: some 16 rays in each are enough.
    uint32_t blockSize = 0;
    /// gpu::RayMoments of each block, row by row: blocks().x * blocks().y.
    Buffer moments;
    /// Whether there are `statistics` in place of `moments`. Known from plan() on.
    bool hasStatistics = false;
    /// gpu::RayStatistics of each block and its surroundings, row by row.
    Buffer statistics;

    static ImageDesc desc(const Frame& frame, uint32_t samples) {
        ImageDesc desc;
        desc.format = VK_FORMAT_R32G32B32A32_SFLOAT;
        desc.extent = {gbufferExtent(frame, samples), 1};
        return desc;
    }
    /// Blocks of a G-buffer of so many texels; needs a `blockSize`.
    glm::uvec2 blocks(glm::uvec2 texels) const { return (texels + blockSize - 1u) / blockSize; }
    uint64_t momentsBytes(glm::uvec2 texels) const {
        const glm::uvec2 count = blocks(texels);
        return uint64_t(count.x) * count.y * sizeof(gpu::RayMoments);
    }
    uint64_t statisticsBytes(glm::uvec2 texels) const {
        const glm::uvec2 count = blocks(texels);
        return uint64_t(count.x) * count.y * sizeof(gpu::RayStatistics);
    }

    /// Plans this as the mean over frames of `source`, which has the variance of rays of a frame. @param samples of the
    /// G-buffer.
    void planAccumulated(PassPlan& plan, const NoisyIrradiance& source, uint32_t samples) {
        lightBounces = source.lightBounces;
        spacing = source.spacing;
        blockSize = source.blockSize;
        hasStatistics = source.hasStatistics;
        const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
        plan.image(irradiance, "accumulated irradiance", desc(plan.frame, samples));
        if (hasStatistics)
            plan.buffer(statistics, "statistics of rays", statisticsBytes(texels));
        else if (blockSize > 0)
            plan.buffer(moments, "moments of rays", momentsBytes(texels));
    }
    /// Takes over the variance of a ray, which does not depend on the number of rays.
    void copyVariance(CommandStream& stream, const NoisyIrradiance& source) const {
        if (hasStatistics)
            stream.copy(source.statistics, statistics, statistics.bytes());
        else if (blockSize > 0)
            stream.copy(source.moments, moments, moments.bytes());
    }

    std::vector<const Image*> checkedImages() const override { return {&irradiance}; }
    std::vector<const Buffer*> checkedBuffers() const override { return {&moments, &statistics}; }
    std::vector<Elements> elements() const override {
        return {{&moments, Elements::Type::Float32, sizeof(gpu::RayMoments) / sizeof(float)},
                {&statistics, Elements::Type::Float32, sizeof(gpu::RayStatistics) / sizeof(float)}};
    }
};

}  // namespace voxray

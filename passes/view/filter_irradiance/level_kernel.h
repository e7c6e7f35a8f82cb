#pragma once

#include <string>

#include "graph/pass.h"
#include "passes/view/filter_irradiance/strip.h"
#include "vulkan/indirect.h"

namespace voxray {

/// One level of an à-trous wavelet over the elements of filter_irradiance (level.glsl).
class LevelKernel {
 public:
    /// @param file a shader of this folder that includes level.glsl.
    LevelKernel(ProgramOwner& owner, const std::string& file)
        : first_(owner, "passes/view/filter_irradiance/" + file),
          second_(owner, "passes/view/filter_irradiance/" + file, {{"LISTED", "1"}}) {}

    /// In plan(). @param hasSecond whether pixels may have second surfaces.
    void define(const Defines& defines, bool isUsed, bool hasSecond) {
        hasSecond_ = hasSecond;
        first_.define(defines);
        second_.define(defines);
        first_.compileIf(isUsed);
        second_.compileIf(isUsed && hasSecond);
    }

    /// @param second pixels that may have a second surface (surfaces.comp). weights: of these and first ones.
    void record(PassContext& context, uint32_t level, const Bindings& bindings, const Buffer& second,
                const Buffer& weights) const {
        const glm::uvec2 pixels = context.frame.pixels();
        const glm::uvec2 strip = glm::uvec2(STRIP_COLUMNS, STRIP_ROWS) << level;
        const glm::uvec2 strips = ((pixels + strip - 1u) / strip) << level;
        const Bindings common{bindings.all(), {"pixels", pixels}, {"level", level}, ifUsed({"WeightsRef", weights})};
        if (hasSecond_) dispatchIndirect(context.stream, second_, second, 0, {common.all(), {"indirectList", second}});
        context.dispatch(first_, strips, common);
    }

 private:
    Kernel first_, second_;
    bool hasSecond_ = false;
};

}  // namespace voxray

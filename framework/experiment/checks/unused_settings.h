#pragma once

#include <map>
#include <string>

#include "experiment/study.h"
#include "scene/scene.h"

namespace voxray {

/// Refuses parameters that are written without effect. One that has an effect in some variants stays: a
/// sweep over the choice that it belongs to leaves it unused in the others.
/// @throws UsageError at the parameter's own place.
void refuseUnusedParameters(const Study& study);

/// Finds settings of motion and time that have no effect in any variant: where nothing is animated, or there
/// is but one frame. A sweep over scenes may leave them so in some.
class UnusedMotion {
 public:
    explicit UnusedMotion(const MeasureSettings& measure) : measure_(measure) {}

    /// Takes note of what one variant asks for. `scene` is what it renders.
    void look(const Variant& variant, const Scene& scene);

    /// @throws UsageError with file and line for the first setting that has no effect in any variant.
    void refuse() const;

 private:
    struct Use {
        bool hasEffect = false;
        TextLocation where;  ///< In the first variant that has it.
        std::string why;
    };

    const MeasureSettings& measure_;
    std::map<std::string, Use> uses_;  ///< By path.
};

}  // namespace voxray

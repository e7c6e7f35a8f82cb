#pragma once

#include <map>
#include <string>

#include "experiment/study.h"
#include "scene/scene.h"

namespace voxray {

/// Rejects parameters in the config that have no effect in any variant. With a sweep a parameter may be
/// unused in some of the variants.
/// @throws UsageError at the parameter's location.
void refuseUnusedParameters(const Study& study);

/// Finds settings of motion and time that have no effect in any variant, because nothing is animated or there
/// is only one frame.
class UnusedMotionSettings {
 public:
    explicit UnusedMotionSettings(const MeasureSettings& measure) : measure_(measure) {}

    /// Adds the settings of a variant, which renders `scene`.
    void add(const Variant& variant, const Scene& scene);

    /// @throws UsageError with file and line for the first setting that has no effect in any variant.
    void throwIfAny() const;

 private:
    struct Use {
        bool hasEffect = false;
        TextLocation where;  ///< In the first variant that has it.
        std::string why;
    };

    const MeasureSettings& measure_;
    std::map<std::string, Use> uses_;  ///< By path of the setting.
};

}  // namespace voxray

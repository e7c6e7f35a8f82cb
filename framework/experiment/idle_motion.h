#pragma once

#include <map>
#include <string>

#include "config/sweep.h"
#include "scene/scene.h"

namespace voxray {

/// Finds settings of motion and time that have no effect in any variant: where nothing is animated, or there
/// is but one frame. A sweep over scenes may leave them so in some.
class IdleMotion {
 public:
    explicit IdleMotion(const MeasureSettings& measure) : measure_(measure) {}

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

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/pixel_masks.h"
#include "experiment/scene_setup.h"
#include "experiment/validate.h"

namespace voxray {

/// What checkPlans() found.
struct PlanCheck {
    std::vector<std::string> warnings;  ///< Most with file and line.
    MaskSelections masks;               ///< Of all scenes and sizes of images, where there is a reference.
};

/// Prepares the scene of every variant and plans its graph and the reference's there, so that what a pass
/// refuses shows before anything is rendered. How much memory the device has does not count.
/// @return what masks select, and warnings: passes that run in no variant; what checkView() says of views
/// and lights, and additionWarnings() of added scenes; an image that lacks direct or indirect light; a
/// variant whose light bounces more or fewer times than the reference's, which shows as a difference that no
/// other parameter lowers; a pass that goes on from frame to frame where too few lead up to the compared one;
/// variants over the config's own limit of memory. A config may ask for each of these.
/// @param only the index of the variant to look at alone; what can be said of all variants together is left
/// out.
/// @throws UsageError with file and line: for a scene as SceneLoader::prepare(); where all variants are over
/// the limit of memory; for settings of the scene without effect in all variants that have them.
PlanCheck checkPlans(WiredExperiment& wired, SceneLoader& loader, const DeviceInfo& device,
                     const Registry& registry, std::optional<size_t> only = std::nullopt);

}  // namespace voxray

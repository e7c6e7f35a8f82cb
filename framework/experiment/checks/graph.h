#pragma once

#include <string>
#include <vector>

#include "experiment/study.h"

/// Checks of graphs and sweep that need no scene. All of them throw UsageError with file and line.
namespace voxray {

/// Checks names of passes. This is done before the sweep's paths are looked up, since a misspelt pass in the
/// graph would be reported as a misspelt path.
void checkPassNames(const Experiment& experiment, const Registry& registry);

/// Checks the graph as the config gives it, without the sweep: also values that the sweep replaces in all variants.
void checkGraphWithoutSweep(const Experiment& experiment, const std::vector<Variant>& variants,
                            const Registry& registry);

/// Rejects lights that are switched off after the last frame.
void checkLightSwitchTimes(const SceneSettings& scene, const MeasureSettings& measure);

/// Rejects swept values that are passes, if such a pass runs in no variant while that of another value does, e.g. a
/// chain without its last pass.
void checkSweptPasses(const Study& study);

/// Rejects a pass that overwrites the image of another pass, if that leaves several passes unused.
void checkNoImageIsOverwritten(const Study& study);

/// The id of a pass that runs in no variant because a later pass also writes the compared image; "": none.
std::string overwrittenPass(const Study& study);

/// Explains why a pass runs in no variant, with file and line and what to do (Graph::whyCulled()).
std::string whyNeverRun(const Study& study, const std::string& id);

}  // namespace voxray

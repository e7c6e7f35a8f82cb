#pragma once

#include <string>
#include <vector>

#include "experiment/study.h"

/// What of graphs and sweep shows before anything is loaded. All of these throw UsageError with file and
/// line.
namespace voxray {

/// Names of passes, before the sweep's paths are looked up among their ids: a pass that is misspelt in the
/// graph would else be told as a misspelt path.
void checkPassNames(const Experiment& experiment, const Registry& registry);

/// Values in the graph that a sweep replaces in every variant are read here alone.
void checkOwnValues(const Experiment& experiment, const std::vector<Variant>& variants,
                    const Registry& registry);

/// A light that goes off after the last frame never does.
void checkLightsGoOff(const SceneSettings& scene, const MeasureSettings& measure);

/// A value of a sweep over whole passes whose pass runs in no variant, while another value's does: such as a
/// chain whose last pass is missing.
void checkSwaps(const Study& study);

/// A pass that writes over another's image leaves more passes than that one without a use.
void checkIsNotOverwritten(const Study& study);

/// A pass that runs in no variant and writes the image that is compared, which a later one writes too; ""
/// where there is none.
std::string overwrittenPass(const Study& study);

/// Why a pass runs in no variant, with file and line, and what to do (Graph::whyCulled()).
std::string whyNeverRun(const Study& study, const std::string& id);

}  // namespace voxray

#pragma once

#include "experiment/checks/diagnostic.h"
#include "experiment/checks/view.h"
#include "experiment/study.h"

/// What is looked at before anything is rendered, for it may make a result misleading. A config may ask for
/// each of these: they warn. What can't be meant is refused by throwing UsageError.
namespace voxray {

class LightRays;

/// A variant whose graph is planned on its scene.
struct PlannedVariant {
    const Study& study;
    const Variant& variant;
    const PreparedScene& scene;
    bool isNewScene;  ///< The variant before has another one: time to say what holds for the scene.
    SceneLoader& loader;
    LightRays& lightRays;
    double metal;            ///< ViewCheck::metal
    const Graph* reference;  ///< Planned on the same scene; nullptr: there is none.
};

/// Looks at one thing and adds what there is to say of it.
template <typename What>
using Check = void (*)(const What& what, Diagnostics& found);

// Lights (lights.cpp)
void sunsThatAreShutOut(const View&, Diagnostics&);
void lightsThatLightNothing(const View&, Diagnostics&);
void spotAngleInRadians(const View&, Diagnostics&);
// The camera (camera.cpp)
void cameraAngleInRadians(const View&, Diagnostics&);
void cameraSeesLittle(const View&, Diagnostics&);
void cameraSeesNoLight(const View&, Diagnostics&);
// Its exposure (exposure.cpp), the region of the voxels (region.cpp)
void exposureOfAllWhiteOrBlack(const View&, Diagnostics&);
void sceneMuchLargerThanView(const View&, Diagnostics&);

/// Of what the camera sees, once for all variants that share it.
inline constexpr Check<View> kViewChecks[] = {
    sunsThatAreShutOut, lightsThatLightNothing, cameraAngleInRadians,      sceneMuchLargerThanView,
    spotAngleInRadians, cameraSeesLittle,       exposureOfAllWhiteOrBlack, cameraSeesNoLight};

// The scene (scene.cpp)
void checkAddedSceneUnits(const PlannedVariant&, Diagnostics&);
/// A scene in centimetres is 100 times too large among metres. A flat one, such as a ground, may have any
/// size.
/// @param prepared of `scene`; `loader` has loaded it.
Diagnostics checkAddedSceneUnits(const SceneSettings& scene, const PreparedScene& prepared,
                                 SceneLoader& loader);
void lightsThatAreNotThere(const PlannedVariant&, Diagnostics&);
void spheresThatStandStill(const PlannedVariant&, Diagnostics&);
// Time and memory (cost.cpp)
void lightRaysThatTakeLong(const PlannedVariant&, Diagnostics&);
// What is compared (comparison.cpp)
void shortHistory(const PlannedVariant&, Diagnostics&);
void missingLight(const PlannedVariant&, Diagnostics&);
void otherBounces(const PlannedVariant&, Diagnostics&);
void missingLobes(const PlannedVariant&, Diagnostics&);

/// Of each variant.
inline constexpr Check<PlannedVariant> kVariantChecks[] = {
    checkAddedSceneUnits, lightsThatAreNotThere, spheresThatStandStill, lightRaysThatTakeLong,
    shortHistory,         missingLight,          otherBounces,          missingLobes};

void unequalHalves(const Study&, Diagnostics&);       // comparison.cpp
void overTheMemoryLimit(const Study&, Diagnostics&);  // cost.cpp
void passesThatNeverRun(const Study&, Diagnostics&);  // graph.cpp

/// Of all variants together.
inline constexpr Check<Study> kStudyChecks[] = {unequalHalves, overTheMemoryLimit, passesThatNeverRun};

}  // namespace voxray

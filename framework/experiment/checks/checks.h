#pragma once

#include "experiment/checks/diagnostic.h"
#include "experiment/checks/view.h"
#include "experiment/study.h"

/// Checks that are done before anything is rendered. They warn of settings that may make a result misleading
/// but may be intended. Settings that can't be intended throw UsageError.
namespace voxray {

class ShadowRayCost;

/// A variant whose graph is planned on its scene.
struct PlannedVariant {
    const Study& study;
    const Variant& variant;
    const PreparedScene& scene;
    bool isNewScene;  ///< Whether the previous variant has another scene; then the scene itself is checked.
    SceneLoader& loader;
    ShadowRayCost& shadowRayCost;
    double visibleMetalFraction;  ///< ViewCheck::visibleMetalFraction
    const Graph* reference;       ///< Planned on the same scene; nullptr: no reference.
};

/// A check, which appends its diagnostics to `found`.
template <typename What>
using Check = void (*)(const What& what, Diagnostics& found);

// Lights (lights.cpp)
void occludedSuns(const View&, Diagnostics&);
void ineffectiveLights(const View&, Diagnostics&);
void spotAngleInRadians(const View&, Diagnostics&);
// The camera (camera.cpp)
void cameraAngleInRadians(const View&, Diagnostics&);
void cameraSeesLittle(const View&, Diagnostics&);
void cameraSeesNoLight(const View&, Diagnostics&);
// Its exposure (exposure.cpp), the region of the voxels (region.cpp)
void extremeExposure(const View&, Diagnostics&);
void sceneMuchLargerThanView(const View&, Diagnostics&);

/// Checks of the camera's view, done once for all variants that share it.
inline constexpr Check<View> kViewChecks[] = {
    occludedSuns,       ineffectiveLights, cameraAngleInRadians, sceneMuchLargerThanView,
    spotAngleInRadians, cameraSeesLittle,  extremeExposure,      cameraSeesNoLight};

// The scene (scene.cpp)
void checkAddedSceneUnits(const PlannedVariant&, Diagnostics&);
/// Warns of added scenes of another unit: one in centimetres is 100 times too large. A flat scene, such as a
/// ground plane, may have any size.
/// @param prepared that of `scene`, which `loader` has loaded.
Diagnostics checkAddedSceneUnits(const SceneSettings& scene, const PreparedScene& prepared, SceneLoader& loader);
void keepFileLightsWithoutLights(const PlannedVariant&, Diagnostics&);
void staticSwings(const PlannedVariant&, Diagnostics&);
// Time and memory (cost.cpp)
void slowShadowRays(const PlannedVariant&, Diagnostics&);
// What is compared (comparison.cpp)
void shortHistory(const PlannedVariant&, Diagnostics&);
void missingLight(const PlannedVariant&, Diagnostics&);
void differentBounces(const PlannedVariant&, Diagnostics&);
void missingLobes(const PlannedVariant&, Diagnostics&);

/// Checks of each variant.
inline constexpr Check<PlannedVariant> kVariantChecks[] = {checkAddedSceneUnits, keepFileLightsWithoutLights,
                                                           staticSwings,         slowShadowRays,
                                                           shortHistory,         missingLight,
                                                           differentBounces,     missingLobes};

void unequalHalves(const Study&, Diagnostics&);        // comparison.cpp
void exceededMemoryLimit(const Study&, Diagnostics&);  // cost.cpp
void unusedPasses(const Study&, Diagnostics&);         // graph.cpp

/// Checks of all variants together.
inline constexpr Check<Study> kStudyChecks[] = {unequalHalves, exceededMemoryLimit, unusedPasses};

}  // namespace voxray

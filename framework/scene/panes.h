#pragma once

#include <memory>

#include "scene/geometry.h"

namespace voxray {

/// Panes are surfaces that light passes straight on: of a material with KHR_materials_transmission that
/// transmits at least half of it. What a pane would reflect, bend or scatter is left out. So rays meet panes
/// nowhere: they are parted from the scene before anything sees it. Each pane on the way from a light, a lamp
/// or the sky to the surface that it lights multiplies the light by its transmittance, transmission * base
/// colour * (1 - metallic). Between surfaces, and to the camera, panes are clear.
bool isPane(const Material& material);

/// A scene's surfaces and its panes, each with all of its materials and nodes.
struct PartedScene {
    std::shared_ptr<const Scene> surfaces;
    std::shared_ptr<const Scene> panes;  ///< nullptr: there are none.
};

/// Parts a scene. One that would be left without any surface has no panes.
PartedScene partPanes(std::shared_ptr<const Scene> scene);

/// `evaluate` of both parts.
SceneState evaluateParted(std::shared_ptr<const Scene> scene, double timeSeconds,
                          Playback playback = Playback::Frozen);

/// Whether a state has panes that take anything from light which passes them: a colour by factor, vertex
/// colours or texture.
bool dimsLight(const SceneState& state);

}  // namespace voxray

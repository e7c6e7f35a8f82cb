#pragma once

#include <memory>

#include "scene/geometry.h"

namespace voxray {

/// Panes are surfaces that transmit light straight: their KHR_materials_transmission is at least 0.5.
/// Reflection, refraction and scattering at panes are ignored, so rays don't hit them: they are split off the
/// scene. Each pane between a light, an emissive surface or the sky and a lit surface multiplies the light by
/// its transmittance, transmission * base colour * (1 - metallic). Between surfaces, and to the camera, panes
/// are clear.
bool isPane(const Material& material);

/// A scene's surfaces and panes as scenes, each with all materials and nodes.
struct SplitScene {
    std::shared_ptr<const Scene> surfaces;
    std::shared_ptr<const Scene> panes;  ///< nullptr: none.
};

/// Splits panes off a scene, unless no surface would be left.
SplitScene splitPanes(std::shared_ptr<const Scene> scene);

/// `evaluate` of surfaces and panes.
SceneState evaluateWithPanes(std::shared_ptr<const Scene> scene, double timeSeconds,
                             Playback playback = Playback::Frozen);

/// Whether a state has panes with a transmittance below 1, by factors, vertex colours or textures.
bool dimsLight(const SceneState& state);

}  // namespace voxray

#pragma once

#include <string>
#include <vector>

#include "passes/common/lights/light_sources.h"
#include "shaders/lights/light_view_types.h"

namespace voxray {

/// The scene's light sources if all are punctual. @throws Error naming the pass if there is none, or one of
/// another kind, for which it recommends `instead`.
std::vector<LightSource> requirePunctualLights(const SceneState& state, const std::string& pass,
                                               const std::string& instead = "inject_light_rays");

/// The views that cover all that a punctual light illuminates: six, the faces of a cube map in the
/// order +x -x +y -y +z -z; of a spot light of up to 90° one, along its axis; of a directional light one,
/// around the scene's bounding sphere. The near plane is at 0.0001 of the far plane's distance.
/// passes/common/lights/light_view.vert rasterizes triangles into them.
std::vector<gpu::LightView> lightViews(const Light& light, const Geometry& geometry);

}  // namespace voxray

#pragma once

#include <string>
#include <vector>

#include "passes/common/lights/light_sources.h"
#include "shaders/lights/light_view_types.h"

namespace voxray {

/// The scene's sources of light, all of which have a viewpoint to rasterise the scene from. @throws Error
/// naming the pass where there is none, or one of another kind, and then what to use `instead`.
std::vector<LightSource> requirePunctualLights(const SceneState& state, const std::string& pass,
                                               const std::string& instead = "inject_light_rays");

/// The views that see all that a punctual light shines on. Six are a cube's sides, in the order +x -x +y -y
/// +z -z; a spot whose cone fits into one side has one, along its axis; parallel light has one over the
/// scene's bounding sphere. What lies nearer to a light than 0.0001 of its farthest depth is not seen.
/// passes/common/lights/light_view.vert rasterises triangles into them.
std::vector<gpu::LightView> lightViews(const Light& light, const Geometry& geometry);

}  // namespace voxray

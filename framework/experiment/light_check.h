#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// A point off a surface that the camera sees, with the unit normal of the side that it sees.
struct SeenPoint {
    glm::vec3 position, normal;
};

/// Whether the config's own lights light anything, by rays from each of them: in all directions that it
/// shines in, and to triangles all over the scene; and whether any of that is seen. Lights that move are left
/// out: they may yet come to it.
/// @param tracer of `state`, in the compared frame. @param seen of the image, evenly.
/// @param isFound asked of a light that no seen point has in sight: whether what it lights is seen, by
/// reflections. @return a warning, with its place in the config, of each light whose rays meet no surface, or
/// the backs of surfaces alone: it points past the scene, stands outside of it or inside of a solid; and of
/// each whose light does not come to what is seen.
std::vector<std::string> lightWarnings(const SceneSettings& scene, const SceneState& state,
                                       const EmbreeScene& tracer, std::span<const SeenPoint> seen,
                                       const std::function<bool(const Light&)>& isFound);

}  // namespace voxray

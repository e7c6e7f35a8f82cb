#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/scene.h"

/// Meshes of analytic shapes in their own space, with exact normals and without a material. Round ones have the area
/// of the shape itself, so that they send out as much light: their vertices lie a little outside of it.
namespace voxray {

/// Part of a turn about Z, from the angle 0 at +X on.
struct Turn {
    double angle = 6.283185307179586;  ///< Radians, above 0 and at most 2π.
};

/// Around the origin, poles along Z, fronts outwards, between two angles from +Z. Texture coordinates: angle about Z
/// over that of the turn, angle from +Z over π.
Mesh sphereShape(double radius, const Turn& turn = {}, double fromAngle = 0, double toAngle = 3.141592653589793);

/// A ring about Z at this height, front to +Z; a disk for an inner radius of 0. Texture coordinates: angle about Z
/// over that of the turn, (r - inner) / (outer - inner).
Mesh diskShape(double height, double inner, double outer, const Turn& turn = {});

/// About Z, open at both ends, fronts outwards. Texture coordinates: angle about Z over that of the turn, 0 at the
/// bottom and 1 at the top.
Mesh cylinderShape(double radius, double bottom, double top, const Turn& turn = {});

/// From -1 to 1 along X and Y, front to +Z. Texture coordinates: (0, 0) at (-1, -1), (1, 1) at (1, 1).
Mesh rectangleShape();

/// From -1 to 1 along all axes, fronts outwards. Texture coordinates from 0 to 1 on each face.
Mesh cubeShape();

}  // namespace voxray

#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "image/image.h"
#include "scene/memory_budget.h"
#include "scene/scene.h"

/// Environment maps of other renderers as equirectangular ones.
namespace voxray {

/// Radiance along a unit vector that points away from the scene.
using RadianceAlong = std::function<glm::vec3(const glm::dvec3& direction)>;

/// A map of this many rows, twice as wide: means over the solid angle of each pixel, by samples.
/// @param toMap from the scene's world to the space of `radiance`; only its rotation and mirroring count
/// @throws Error for more memory than the bound
std::shared_ptr<const ImageF> environmentMap(uint32_t height, const glm::dmat3& toMap, const RadianceAlong& radiance,
                                             MemoryBudget& memory);

/// The radiance of a map as Environment has it, bilinear.
glm::vec3 radianceOfMap(const ImageF& map, const glm::dvec3& direction);

/// Both together. Maps are added in the size of the finer one.
Environment sumOfEnvironments(const Environment& a, const Environment& b);

/// The texel at u, v down from the first row; columns continue on the other side. For maps that environmentMap()
/// samples: where its pixels are theirs, they are copied.
glm::vec3 nearestTexel(const ImageF& image, double u, double v);

/// Bilinear lookup in texels whose centers are at (i + 0.5) / size. @param u, v down from the first row. @param
/// repeatU columns continue on the other side; rows and other columns are held
glm::vec3 bilinear(const ImageF& image, double u, double v, bool repeatU);

}  // namespace voxray

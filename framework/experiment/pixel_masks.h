#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "config/settings.h"
#include "experiment/checks/diagnostic.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

/// What a camera sees of a scene, found on the host: masks of pixels, and numbers of what is seen. It is
/// traced through Embree and not taken from a variant's G-buffer, so that all variants of a scene are scored
/// on the same pixels, path-traced ones too.
namespace voxray {

/// The pixels that a mask of the config selects.
struct PixelSelection {
    std::string name;
    std::vector<uint8_t> pixels;  ///< A byte a pixel, 1 where it is selected; see PixelMask.
    size_t count = 0;             ///< Of selected pixels.
};

/// Names that a mask's `object` may have in a scene: of meshes, and of nodes that place them, each once.
std::vector<std::string> objectNames(const Scene& scene);

/// @throws UsageError with file, line and the nearest name for a material or object that the scene lacks.
void checkMaskNames(const std::vector<MaskSettings>& masks, const Scene& scene);

/// A pixel is selected where all four of its sub-pixel centers (2 x 2) see a surface that meets the mask's
/// conditions: one at an edge mixes surfaces, and is in no mask of either.
/// @throws UsageError with file, line and the nearest name for a material or mesh that the scene lacks.
std::vector<PixelSelection> selectPixels(const std::vector<MaskSettings>& masks, const SceneState& state,
                                         const Camera& camera, uint32_t width, uint32_t height);

/// Masks that select no pixel of an image, or all.
/// @param selections of these masks, as selectPixels() returns them.
Diagnostics maskWarnings(const std::vector<MaskSettings>& masks,
                         const std::vector<PixelSelection>& selections, const SceneState& state);

/// What the masks of a config select in the compared frame, by maskKey().
using MaskSelections = std::map<std::string, std::vector<PixelSelection>>;

/// Tells scenes and sizes of images apart. @param sceneKey as of SceneLoader::key(), with the camera.
std::string maskKey(const std::string& sceneKey, const ImageSettings& image);

/// What the camera sees through the center of a pixel.
struct PrimaryHit {
    float depth = 0;        ///< Distance along the camera's axis, m; +inf where nothing is hit.
    int32_t instance = -1;  ///< Index into Scene::instances; -1: none.
    int32_t material = -1;  ///< Index into Scene::materials; -1: none.
};
/// Of all pixels, row by row.
std::vector<PrimaryHit> primaryHits(const SceneState& state, const Camera& camera, uint32_t width,
                                    uint32_t height);

}  // namespace voxray

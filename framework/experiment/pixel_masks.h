#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "config/settings.h"
#include "experiment/checks/diagnostic.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

/// Masks of pixels, and instance and material of each pixel. Camera rays are traced with Embree, instead of
/// reading a variant's G-buffer, so that all variants of a scene are scored on the same pixels, including
/// path-traced ones.
namespace voxray {

/// The pixels that a mask of the config selects.
struct PixelSelection {
    std::string name;
    std::vector<uint8_t> pixels;  ///< A byte for each pixel, 1 if it is selected; see PixelMask.
    size_t count = 0;             ///< Number of selected pixels.
};

/// Names that a mask's `object` may have in a scene: those of meshes and of their nodes, each once.
std::vector<std::string> objectNames(const Scene& scene);

/// @throws UsageError for a material or object that the scene lacks, with the most similar name.
void checkMaskNames(const std::vector<MaskSettings>& masks, const Scene& scene);

/// Selects a pixel if camera rays through the centers of its 2 x 2 sub-pixels all hit surfaces that meet the
/// mask's conditions. So pixels at edges, which mix surfaces, are not selected.
/// @throws UsageError with file, line and the most similar name for a material or mesh that the scene lacks.
std::vector<PixelSelection> selectPixels(const std::vector<MaskSettings>& masks, const SceneState& state,
                                         const Camera& camera, uint32_t width, uint32_t height);

/// Warns of masks that select no pixel of an image or all of them.
/// @param selections of these masks, as selectPixels() returns them.
Diagnostics maskWarnings(const std::vector<MaskSettings>& masks, const std::vector<PixelSelection>& selections,
                         const SceneState& state);

/// Selections of a config's masks in the compared frame, by maskKey().
using MaskSelections = std::map<std::string, std::vector<PixelSelection>>;

/// Key of a scene and image size. @param sceneKey SceneLoader::key(), which includes the camera.
std::string maskKey(const std::string& sceneKey, const ImageSettings& image);

/// The first hit of a camera ray through the center of a pixel.
struct PrimaryHit {
    float depth = 0;        ///< Distance along the camera's axis, m; +inf if nothing is hit.
    int32_t instance = -1;  ///< Index into Scene::instances; -1: none.
    int32_t material = -1;  ///< Index into Scene::materials; -1: none.
};
/// Primary hits of all pixels, row by row.
std::vector<PrimaryHit> primaryHits(const SceneState& state, const Camera& camera, uint32_t width, uint32_t height);

}  // namespace voxray

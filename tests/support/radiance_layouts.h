#pragma once

#include <string>

#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray::test {

/// A layout of radiance voxels, with parameters for small scenes.
struct TestedLayout {
    std::string filter;          ///< The layout and its parameters: what follows 'filter_voxels, layout: '.
    bool followsCamera = false;  ///< Holds what is near the camera alone: takes no bounces by cones.
};

inline const TestedLayout kRadianceLayouts[] = {{"dense"},
                                                {"svo"},
                                                {"clipmap, clipmap_resolution: 16", true},
                                                {"textures"},
                                                {"clipmap_textures, clipmap_resolution: 16", true}};
/// As published: one direction; with tests of their own.
inline constexpr std::array kPublishedLayouts{RadianceLayout::SvoBricks};
static_assert(std::size(kRadianceLayouts) + std::size(kPublishedLayouts) == EnumNames<RadianceLayout>::names.size(),
              "a layout that no test knows");

}  // namespace voxray::test

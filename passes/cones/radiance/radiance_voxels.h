#pragma once

#include <array>
#include <vector>

#include "graph/pass.h"
#include "passes/common/octree/octree.h"
#include "passes/cones/radiance/radiance_types.h"

namespace voxray {

/// How radiance voxels are stored. Shaders of layout `x` are compiled with RADIANCE_X
/// (passes/cones/radiance/radiance_voxels.glsl).
enum class RadianceLayout { Dense, Svo, Clipmap, Textures, ClipmapTextures, SvoBricks };
template <>
struct EnumNames<RadianceLayout> {
    static constexpr std::array names{std::pair{RadianceLayout::Dense, "dense"},
                                      std::pair{RadianceLayout::Svo, "svo"},
                                      std::pair{RadianceLayout::Clipmap, "clipmap"},
                                      std::pair{RadianceLayout::Textures, "textures"},
                                      std::pair{RadianceLayout::ClipmapTextures, "clipmap_textures"},
                                      std::pair{RadianceLayout::SvoBricks, "svo_bricks"}};
};
constexpr const char* kRadianceLayoutHelp =
    "How voxels are stored: dense, a full grid for each level; "
    "svo, a sparse octree of the voxels that surfaces pass through; "
    "clipmap, a window of each level around the camera, updated in each frame; "
    "textures and clipmap_textures, dense and clipmap in a 3D texture that the device's sampler filters, "
    "as in Arnebäck 2017, to compare hardware filtering with ours; "
    "svo_bricks, an octree as published there, for comparison with svo: 8 bits a channel, one direction.";

/// Outgoing radiance and opacity of surfaces, prefiltered at all scales. A shader that samples them includes
/// passes/cones/radiance/radiance_voxels.glsl, is compiled with defines() and given bindings(), for any
/// layout.
struct RadianceVoxels : Resource {
    // Known from plan() on, except the grid's unit:
    RadianceLayout layout = RadianceLayout::Dense;
    gpu::RadianceGrid grid{};
    bool euclidean = false;  ///< Levels of a clipmap are chosen by Euclidean distance.
    bool emission = false;   ///< Radiance includes what surfaces emit.

    Buffer header;                ///< RadianceGrid, then what the layout needs to find its values.
    std::vector<Buffer> storage;  ///< What the header's addresses point to.
    Image texture;                ///< Values of the texture layouts, in half floats.
    Sampler sampler;              ///< Of the texture.
    Octree octree;                ///< Structure of the svo layout; `storage` holds its nodes' values.

    Defines defines() const;
    std::vector<Binding> bindings() const;
    /// Bindings of a shader that stores values. @param mipLevel of the texture, if any.
    std::vector<Binding> fillBindings(uint32_t mipLevel = 0) const;
};

}  // namespace voxray

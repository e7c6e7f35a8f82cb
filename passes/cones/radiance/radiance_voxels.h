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
    "How voxels are stored: dense, a full grid for each level; svo, a sparse octree: only what surfaces pass "
    "through; clipmap, of each level a window round the camera, which follows it in each frame; "
    "textures and clipmap_textures, dense and clipmap in a 3D texture that the device's sampler filters, as "
    "in Arnebäck 2017, to compare hardware filtering with ours; svo_bricks, an octree as published there, "
    "for comparison with svo: 8 bits a channel, one direction.";

/// Radiance that leaves surfaces and their opacity, prefiltered at all scales. A shader that samples it is
/// compiled with defines(), includes passes/cones/radiance/radiance_voxels.glsl and is given bindings(): it
/// is written once for all layouts.
struct RadianceVoxels : Resource {
    RadianceLayout layout = RadianceLayout::Dense;  ///< Known from plan() on, as is the grid but its unit.
    gpu::RadianceGrid grid{};
    bool euclidean = false;       ///< Levels of a clipmap are chosen by Euclidean distance. Likewise.
    bool emission = false;        ///< With what surfaces emit. Known from plan() on.
    Buffer header;                ///< RadianceGrid, then what the layout needs to find its values.
    std::vector<Buffer> storage;  ///< What the header's addresses lead to.
    Image texture;                ///< Where values stand in one, in half floats.
    Sampler sampler;              ///< Of the texture.
    Octree octree;                ///< Where there is one: the structure whose nodes' values `storage` holds.

    Defines defines() const;
    std::vector<Binding> bindings() const;
    /// The same for a shader that stores values. @param mipLevel of the texture, if any.
    std::vector<Binding> fillBindings(uint32_t mipLevel = 0) const;
};

}  // namespace voxray

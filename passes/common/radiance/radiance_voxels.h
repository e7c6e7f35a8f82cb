#pragma once

#include <array>
#include <vector>

#include "graph/pass.h"
#include "shaders/radiance/radiance_types.h"

namespace voxray {

/// How radiance voxels are stored.
enum class RadianceLayout { Dense, Svo, Clipmap };
template <>
struct EnumNames<RadianceLayout> {
    static constexpr std::array names{std::pair{RadianceLayout::Dense, "dense"},
                                      std::pair{RadianceLayout::Svo, "svo"},
                                      std::pair{RadianceLayout::Clipmap, "clipmap"}};
};

/// Radiance that leaves surfaces and the part of a beam that they cover, prefiltered at all scales. A shader
/// that samples it is compiled with defines(), includes shaders/radiance/radiance_voxels.glsl and is given
/// bindings(): it is written once for all layouts.
struct RadianceVoxels : Resource {
    RadianceLayout layout = RadianceLayout::Dense;  ///< Known from plan() on, as is the grid but its unit.
    gpu::RadianceGrid grid{};
    Buffer header;                ///< RadianceGrid, then what the layout needs to find its values.
    std::vector<Buffer> storage;  ///< What the header's addresses lead to.

    Defines defines() const;
    std::vector<Binding> bindings() const { return {{"radianceVoxels", header}}; }
};

/// Levels from a grid's voxels to a single one round them all.
uint32_t radianceLevels(glm::uvec3 resolution);

/// Voxels of a level along each axis, of a grid of `resolution`: half as many as of the level below, rounded
/// up.
glm::uvec3 radianceResolution(glm::uvec3 resolution, uint32_t level);

}  // namespace voxray

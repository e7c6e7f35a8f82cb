// Prefiltered radiance and opacity of surfaces at all scales: one accessor for all layouts. The including shader is
// compiled with RadianceVoxels::defines() and given RadianceVoxels::bindings()
// (passes/cones/radiance/radiance_voxels.h).
//
// A voxel stores for each of its six faces the opacity (the area that its surfaces project onto the face over the
// face's area, at most 1), and the outgoing radiance there, times the opacity. A ray reads the faces that oppose it,
// those across axis k once per layer of voxels across k: |direction_k| layers per voxel width of its path. So the
// opacities along a ray through a closed surface add up to 1 for any angle and any interpolation.
#ifndef VOXRAY_RADIANCE_VOXELS_GLSL
#define VOXRAY_RADIANCE_VOXELS_GLSL

#include "passes/cones/radiance/radiance_types.h"

// Voxels of a level along each axis: half as many as of the level below, rounded up.
uvec3 levelResolution(RadianceGrid g, uint level) { return (g.resolution + ((1u << level) - 1u)) >> level; }

// A layout declares `radianceVoxels`, a buffer whose first member is a RadianceGrid named `grid`, and defines, for a
// position in metres:
//  - vec4 sampleLevel(uint level, vec3 position, vec3 direction): what a ray along `direction` (unit) sees in a cube of
//    a voxel's size around `position`, trilinearly interpolated: rgb, the radiance that surfaces there send against
//    `direction`, times their opacity, W/(m² sr); a, the opacity over one voxel's length: 0 in empty space, above 1
//    where surfaces occlude each other;
//  - uint startLevel(vec3 position, float dither): the level whose voxels a cone that starts there must be clear of;
//    between levels it is chosen by `dither`, 0 to 1.
#if defined(RADIANCE_DENSE)
#include "passes/cones/radiance/radiance_dense.glsl"
#elif defined(RADIANCE_TEXTURES)
#include "passes/cones/radiance/radiance_textures.glsl"
#elif defined(RADIANCE_SVO)
#include "passes/cones/radiance/radiance_svo.glsl"
#elif defined(RADIANCE_SVO_BRICKS)
#include "passes/cones/radiance/radiance_svo_bricks.glsl"
#elif defined(RADIANCE_CLIPMAP) || defined(RADIANCE_CLIPMAP_TEXTURES)
#include "passes/cones/radiance/radiance_clipmap.glsl"
#endif

float radianceVoxelSize(uint level) { return radianceVoxels.grid.voxelSize * float(1u << level); }

#endif

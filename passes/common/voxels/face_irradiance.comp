// Irradiance of each voxel's faces, flux over area, of one flux buffer or the sum of two; and the area.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxel_levels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer FluxRef { LargeUints flux; };
layout(scalar) buffer AddedRef { LargeUints added; };
layout(scalar) readonly buffer Area { uint data[]; } area;
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Faces { vec4 data[]; };
layout(scalar) readonly buffer FacesRef { Faces faces; };
layout(push_constant) uniform Push {
    uint count;         // Faces.
    float addedWeight;  // 1: adds `added`; 0: doesn't.
} push;

void main() {
    const uint face = linearIndex();
    if (face >= push.count) return;
    const float a = areaOf(area.data[face / 2u], face);
    const vec3 sum = loadFlux(flux, face) + push.addedWeight * loadFlux(added, face);
    const float size = voxelSizeOf(face / 6u);
    faces.data[face] = a > 0.0 ? vec4(sum / (a * (size * size)), a) : vec4(0.0);
}

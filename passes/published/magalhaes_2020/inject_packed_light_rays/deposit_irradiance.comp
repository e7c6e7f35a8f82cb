// Deposits the irradiance of each ray in the voxel that it hit, then mirrors the ray about the voxel's mean normal.
#include "shaders/compute/linear_index.glsl"
#include "passes/published/magalhaes_2020/packed_voxels.glsl"
#include "passes/published/packed_write.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Intensities { vec3 data[]; } intensities;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer NormalsRef { LargeUints normals; };
layout(scalar) buffer AlbedosRef { LargeUints albedos; };
layout(scalar) buffer IrradianceRef { LargeUints irradiance; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint batchRays;
    uint isLast;
    float white;  // W/m²
    float tMin;   // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    rays.data[i] = kNoRay;
    if (ray.tMax < ray.tMin || hit.triangle == NO_HIT) return;

    // Voxels that voxelization missed count as no hit
    const vec3 position = ray.origin + hit.t * ray.direction;
    const uint index = packedIndex(push.grid, ivec3(floor(voxelCoordinates(push.grid, position))));
    const uint normalWord = normals.data[index];
    if (normalWord == 0u) return;

    // Section 4.3.2.5: intensity times the cosine to the mean normal, over the squared length of this segment only
    const vec3 normal = normalOfColor(packedColor(normalWord));
    const vec3 irradiance_ = intensities.data[i] * (clamp(-dot(ray.direction, normal), 0.0, 1.0) / (hit.t * hit.t));
    writePacked(irradiance, index, irradiance_ / push.white);
    if (push.isLast != 0u) return;

    const vec3 mirrored = reflect(ray.direction, normal);
    if (dot(mirrored, mirrored) == 0.0) return;
    intensities.data[i] = irradiance_ * packedColor(albedos.data[index]);
    rays.data[i] = Ray(position, push.tMin, normalize(mirrored), 1.0e30);
}

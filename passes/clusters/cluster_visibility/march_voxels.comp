// Marches rays from patches through voxels. In a voxel a ray hits one of the surface groups, chosen by visible area.
// BRESENHAM: visits the voxels of a 3D Bresenham line, one for each step along the longest axis, which misses voxels of
// which the ray only cuts a corner (Cosin and Patow 2022, section 4.3).
#include "passes/clusters/cluster_visibility/patch_samples.glsl"
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "passes/clusters/visible_face.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstGroup { uint data[]; } firstGroup;
writeonly buffer PackedHits { uint data[]; } packedHits;

// Origin of a ray: above the surfel, at a height over the plane through its voxel's center perpendicular to its normal.
// The height is half a voxel for an axis-aligned plane, which is above its layer of voxels. A slanted plane intersects
// voxels that extend higher; isOwnSurface() skips these.
vec3 marchOrigin(PatchSurfel s, ivec3 voxel) {
    const vec3 size = abs(s.normal), center = push.grid.origin + push.grid.voxelSize * (vec3(voxel) + 0.5);
    const float height = dot(size, vec3(1.0)) - 0.5 * max(size.x, max(size.y, size.z)) + VOXEL_MARGIN;
    return s.position + (height * push.grid.voxelSize - dot(s.position - center, s.normal)) * s.normal;
}

// The state of a ray during the march.
struct MarchingRay {
    vec3 normal;  // Normal of the surfel at its origin.
    vec3 direction;
    ivec3 startVoxel;
    bool isInLayer;  // All voxels visited so far were occupied.
};

// Whether a group belongs to the surface at the ray's origin, whose back the ray must not hit: the voxel, `offset`
// voxels from the start, lies in the layer that the surface's plane intersects, and the group is flat, within 45
// degrees of that plane and faces away from the ray.
bool isOwnSurface(MarchingRay ray, ivec3 offset, VoxelMaterial m) {
    if (abs(dot(vec3(offset), ray.normal)) > dot(abs(ray.normal), vec3(1.0))) return false;
    const float cosine = dot(m.normal, ray.normal);
    return isFlat(m) && cosine * cosine > 0.5 * dot(m.normal, m.normal) && cosine * dot(m.normal, ray.direction) > 0.0;
}

// Area of a group that is visible to the ray, by axis. The origin of a ray in a corner of a room lies in the voxels of
// the other wall, in front of its surface: groups that face away are skipped until the ray has left these voxels.
vec3 visibleAreas(uint group, MarchingRay ray, ivec3 voxel) {
    if (isOccluded(groups.data[group])) return vec3(0.0);
    const VoxelMaterial m = groupMaterial(group);
    if (ray.isInLayer && isFlat(m) && dot(m.normal, ray.direction) > 0.0) return vec3(0.0);
    return isOwnSurface(ray, voxel - ray.startVoxel, m) ? vec3(0.0) : projectedFaceAreas(m, ray.direction);
}

// Samples one of the groups in a voxel by visible area. False if none is visible, so that the ray continues.
bool hitVoxel(uint rayNumber, MarchingRay ray, ivec3 voxel, float distance_, out uint packedHit) {
    const uint number = voxelNumber(push.grid, voxel);
    float sum = 0.0;
    for (uint group = firstGroup.data[number]; group < firstGroup.data[number + 1u]; ++group)
        sum += dot(visibleAreas(group, ray, voxel), vec3(1.0));
    packedHit = HIT_NOTHING;
    if (sum == 0.0) return false;
    float remaining = sampleHitFace(rayNumber) * sum;
    for (uint group = firstGroup.data[number]; group < firstGroup.data[number + 1u]; ++group) {
        const VoxelMaterial m = groupMaterial(group);
        const vec3 areas = visibleAreas(group, ray, voxel);
        const float area = dot(areas, vec3(1.0));
        if (area == 0.0) continue;
        packedHit = packHitAtDistance(group, pickFace(m, ray.direction, areas, remaining / area), distance_);
        if (remaining < area) break;
        remaining -= area;
    }
    return true;
}

#ifdef BRESENHAM
uint marchRay(uint rayNumber) {
    const PatchSurfel s = sampleSurfel(rayNumber);
    const ivec3 startVoxel = voxelAt(push.grid, s.position);
    MarchingRay ray = MarchingRay(s.normal, sampleDirection(rayNumber, s), startVoxel, true);
    const vec3 start = gridCoordinates(push.grid, marchOrigin(s, startVoxel)), size = abs(ray.direction);
    const float longest = max(size.x, max(size.y, size.z));
    for (uint i = 0u;; ++i) {
        const ivec3 voxel = ivec3(floor(start)) + ivec3(round(float(i) / longest * ray.direction));
        if (!insideGrid(push.grid, voxel)) break;
        uint packedHit;
        if (!isOccupied(push.grid, voxel))
            ray.isInLayer = false;
        else if (hitVoxel(rayNumber, ray, voxel, float(i) / longest, packedHit))
            return packedHit;
    }
    return HIT_NOTHING;
}
#else
// Distance at which a ray leaves the voxel, plus a margin, m.
float exitDistance(ivec3 voxel, vec3 origin, vec3 direction) {
    const vec3 start = gridCoordinates(push.grid, origin);
    const vec3 far = mix(vec3(voxel), vec3(voxel) + 1.0, greaterThan(direction, vec3(0.0)));
    const vec3 distances = mix((far - start) / direction, vec3(1.0e30), lessThan(abs(direction), vec3(1e-9)));
    return (min(distances.x, min(distances.y, distances.z)) + VOXEL_MARGIN) * push.grid.voxelSize;
}

uint marchRay(uint rayNumber) {
    const PatchSurfel s = sampleSurfel(rayNumber);
    const ivec3 startVoxel = voxelAt(push.grid, s.position);
    MarchingRay ray = MarchingRay(s.normal, sampleDirection(rayNumber, s), startVoxel, true);
    const vec3 origin = marchOrigin(s, startVoxel);
    float tMin = 0.0;
    const uint maxVoxels = push.grid.resolution.x + push.grid.resolution.y + push.grid.resolution.z;
    for (uint i = 0u; i < maxVoxels; ++i) {
        VoxelHit hit;
        if (!closest(push.grid, origin, ray.direction, tMin, 1.0e30, hit)) break;
        ray.isInLayer = ray.isInLayer && hit.t <= tMin + 2.0 * VOXEL_MARGIN * push.grid.voxelSize;
        uint packedHit;
        if (hitVoxel(rayNumber, ray, hit.voxel, hit.t / push.grid.voxelSize, packedHit)) return packedHit;
        tMin = max(exitDistance(hit.voxel, origin, ray.direction), tMin + VOXEL_MARGIN * push.grid.voxelSize);
    }
    return HIT_NOTHING;
}
#endif

void main() {
    const uint ray = linearIndex();
    if (ray < push.rayCount) packedHits.data[ray] = marchRay(ray);
    countMarch();
}

// What rays from patches see of the voxels: a thread walks one ray. BRESENHAM: along the voxels of a line in three dimensions, one for
// each step along the axis that it is longest in, so that it passes corners of others by (Cosin and Patow 2022, section 4.3).
#include "passes/clusters/cluster_visibility/face_ray.glsl"
#include "passes/clusters/seen_face.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstSide { uint data[]; } firstSide;
writeonly buffer Met { uint data[]; } met;

// Where rays begin that walk through voxels: above the surfel, off the plane through its voxel's center along its normal. Across an
// axis half a voxel leaves the plane's voxels behind; a slanted one touches voxels that reach further, of which isOwnSurface() knows.
vec3 raisedOrigin(PatchSurfel s, ivec3 voxel) {
    const vec3 size = abs(s.normal), center = push.grid.origin + push.grid.voxelSize * (vec3(voxel) + 0.5);
    const float raised = dot(size, vec3(1.0)) - 0.5 * max(size.x, max(size.y, size.z)) + VOXEL_MARGIN;
    return s.position + (raised * push.grid.voxelSize - dot(s.position - center, s.normal)) * s.normal;
}

// Whether a side is part of the surface that a ray rises from, which it can't see from behind: its voxel's center lies in the layer of
// voxels that the plane touches, and its surfaces are flat, within 45 degrees of that plane and look away from the ray.
bool isOwnSurface(vec3 normal, vec3 direction, ivec3 between, VoxelMaterial m) {
    if (abs(dot(vec3(between), normal)) > dot(abs(normal), vec3(1.0))) return false;
    const float along = dot(m.normal, normal);
    return isFlat(m) && along * along > 0.5 * dot(m.normal, m.normal) && along * dot(m.normal, direction) > 0.0;
}

// A ray on its way.
struct Walk {
    vec3 normal;
    vec3 direction;
    ivec3 own;       // Its surfel's voxel.
    bool isInLayer;  // It has passed from one occupied voxel to the next since it began.
};

// What a side shows of its faces to a ray. In a corner a ray begins among the voxels of the other surface, on its front side, for that
// is where corners are lit: as long as it passes from one of them to the next that surface lies behind it.
vec3 shownBy(uint side, Walk w, ivec3 voxel) {
    if (sides.data[side].isCovered == 1u) return vec3(0.0);
    const VoxelMaterial m = voxelMaterial(side);
    if (w.isInLayer && isFlat(m) && dot(m.normal, w.direction) > 0.0) return vec3(0.0);
    return isOwnSurface(w.normal, w.direction, voxel - w.own, m) ? vec3(0.0) : projectedArea(m, w.direction);
}

// Of all sides in a voxel one, by what they show. False where none shows anything: then the ray goes on.
bool seesVoxel(uint ray, Walk w, ivec3 voxel, float away, out uint word) {
    const uint number = voxelNumber(push.grid, voxel);
    float sum = 0.0;
    for (uint side = firstSide.data[number]; side < firstSide.data[number + 1u]; ++side)
        sum += dot(shownBy(side, w, voxel), vec3(1.0));
    word = MET_NOTHING;
    if (sum == 0.0) return false;
    float at = rayPick(ray) * sum;
    for (uint side = firstSide.data[number]; side < firstSide.data[number + 1u]; ++side) {
        const VoxelMaterial m = voxelMaterial(side);
        const vec3 shown = shownBy(side, w, voxel);
        const float own = dot(shown, vec3(1.0));
        if (own == 0.0) continue;
        word = metAway(side, faceAgainst(m, w.direction, shown, at / own), away);
        if (at < own) break;
        at -= own;
    }
    return true;
}

#ifdef BRESENHAM
uint seenBy(uint ray) {
    const PatchSurfel s = raySurfel(ray);
    const ivec3 own = voxelAt(push.grid, s.position);
    Walk w = Walk(s.normal, rayDirection(ray, s), own, true);
    const vec3 start = inVoxels(push.grid, raisedOrigin(s, own)), size = abs(w.direction);
    const float longest = max(size.x, max(size.y, size.z));
    for (uint i = 0u;; ++i) {
        const ivec3 voxel = ivec3(floor(start)) + ivec3(round(float(i) / longest * w.direction));
        if (!insideGrid(push.grid, voxel)) break;
        uint word;
        if (!isOccupied(push.grid, voxel))
            w.isInLayer = false;
        else if (seesVoxel(ray, w, voxel, float(i) / longest, word))
            return word;
    }
    return MET_NOTHING;
}
#else
// Where a ray leaves a voxel that it is in, and a little on, m.
float leaves(ivec3 voxel, vec3 origin, vec3 direction) {
    const vec3 at = inVoxels(push.grid, origin), far = mix(vec3(voxel), vec3(voxel) + 1.0, greaterThan(direction, vec3(0.0)));
    const vec3 parts = mix((far - at) / direction, vec3(1.0e30), lessThan(abs(direction), vec3(1e-9)));
    return (min(parts.x, min(parts.y, parts.z)) + VOXEL_MARGIN) * push.grid.voxelSize;
}

uint seenBy(uint ray) {
    const PatchSurfel s = raySurfel(ray);
    const ivec3 own = voxelAt(push.grid, s.position);
    Walk w = Walk(s.normal, rayDirection(ray, s), own, true);
    const vec3 origin = raisedOrigin(s, own);
    float from = 0.0;
    // No ray passes more voxels than the grid has along its axes.
    const uint voxels = push.grid.resolution.x + push.grid.resolution.y + push.grid.resolution.z;
    for (uint i = 0u; i < voxels; ++i) {
        VoxelHit hit;
        if (!closest(push.grid, origin, w.direction, from, 1.0e30, hit)) break;
        w.isInLayer = w.isInLayer && hit.t <= from + 2.0 * VOXEL_MARGIN * push.grid.voxelSize;
        uint word;
        if (seesVoxel(ray, w, hit.voxel, hit.t / push.grid.voxelSize, word)) return word;
        from = max(leaves(hit.voxel, origin, w.direction), from + VOXEL_MARGIN * push.grid.voxelSize);
    }
    return MET_NOTHING;
}
#endif

void main() {
    const uint ray = linearIndex();
    if (ray < push.rayCount) met.data[ray] = seenBy(ray);
    countMarch();
}

// Rays from faces of voxels, and what they see. Rays of a face come one after another.
#extension GL_EXT_scalar_block_layout : require
#include "shaders/clusters/cluster_types.h"
#include "shaders/clusters/seen_face.glsl"
#include "shaders/clusters/seen_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer Faces { uint data[]; } faces;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;  // By voxel.
layout(scalar) readonly buffer OfVoxel { uint data[]; } ofVoxel;           // Clusters.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstFace;
    uint rays;      // Of all faces in hand.
    uint raysPerFace;
    uint seed;
    float nearDistance;  // Voxels: what is nearer is seen by voxels, not by clusters.
    uint voxelTargets;
    uint alongAxis;      // 1: the hemisphere stands on the face. 0: on the surfaces before it.
} push;

uint rayFace(uint ray) { return faces.data[push.firstFace + ray / push.raysPerFace]; }

// Numbers of a face's sequences: direction, place, pick.
uint raySeed(uint ray, uint sequence) { return hashCombine(hashCombine(push.seed, sequence), rayFace(ray)); }

// The mean normal of the surfaces before a face, where those of normal n and area a count a n² along the axis. Their mean along it is the
// sum of a n³ over that of a n², by Cauchy and Schwarz no less than the sum of a n² over that of a n, which a voxel holds; both are the
// same for one plane, and where all planes stand across axes, as a floor and a wall: then they are 1.
vec3 surfaceNormal(VoxelMaterial m, vec3 axis, uint along) {
    const vec3 areas = m.unoccludedPositive + m.unoccludedNegative;
    const vec3 mean = dot(m.normal, axis) < 0.0 ? -m.normal : m.normal;
    const float part = areas[along] / dot(areas, vec3(1.0)), first = dot(mean, axis);
    if (part >= first) return axis;
    const float cosine = part / first, sine = sqrt(1.0 - cosine * cosine);
    const vec3 across = mean - first * axis;
    const float size = length(across);
    return normalize(cosine * axis + across * (size > sine ? sine / size : 1.0));
}

// A ray from the surfaces before a face, by the cosine about their normal: from a random point of the plane through the voxel's
// center, moved off that plane. Across an axis half a voxel leaves the plane's voxels behind; a slanted one touches voxels that reach
// further, of which isOwnSurface() knows.
void faceRay(uint ray, out vec3 origin, out vec3 direction, out vec3 normal) {
    const uint face = rayFace(ray), index = ray % push.raysPerFace;
    const vec3 axis = faceNormal(face % 6u);
    normal = push.alongAxis == 1u ? axis : surfaceNormal(voxelMaterial(face / 6u), axis, face / 2u % 3u);
    const vec2 place = sobol2(index, raySeed(ray, 1u)) - 0.5;
    vec3 tangent, bitangent;
    frame(axis, tangent, bitangent);
    const vec3 inFace = tangent * place.x + bitangent * place.y, within = inFace - normal * dot(inFace, normal);
    const vec3 center = push.grid.origin + push.grid.voxelSize * (vec3(coordinates.data[face / 6u]) + 0.5 + within);
    const vec3 size = abs(normal);
    const float raised = dot(size, vec3(1.0)) - 0.5 * max(size.x, max(size.y, size.z)) + VOXEL_MARGIN;
    origin = center + raised * push.grid.voxelSize * normal;
    direction = cosineDirection(sobol2(index, raySeed(ray, 0u)), normal);
}

// Whether a voxel is part of the surface that a ray rises from, which it can't see from behind: its center lies in the layer of voxels
// that the plane touches, and its surfaces are flat, within 45 degrees of that plane and look away from the ray.
bool isOwnSurface(uint ray, vec3 normal, vec3 direction, ivec3 voxel, VoxelMaterial m) {
    const vec3 between = vec3(voxel) - vec3(coordinates.data[rayFace(ray) / 6u]);
    if (abs(dot(between, normal)) > dot(abs(normal), vec3(1.0))) return false;
    const float along = dot(m.normal, normal);
    return isFlat(m) && along * along > 0.5 * dot(m.normal, m.normal) && along * dot(m.normal, direction) > 0.0;
}

// What a ray sees of a voxel: a cluster's face or, near by, the voxel's own. False where it comes from behind the voxel's surfaces.
// A voxel without a cluster blocks and sends nothing.
bool seesVoxel(uint ray, uint voxel, uint seen, float away, out uint target) {
    target = NO_TARGET;
    if (seen == NO_SEEN_FACE) return false;
    const uint cluster = ofVoxel.data[voxel];
    if (cluster == NO_CLUSTER) return true;
    target = away < push.nearDistance ? push.voxelTargets + 6u * voxel + seen : 6u * cluster + seen;
    return true;
}

float rayPick(uint ray) { return toUnit(hashCombine(raySeed(ray, 2u), ray % push.raysPerFace)); }

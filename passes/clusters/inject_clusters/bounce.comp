// One bounce between the faces of clusters' parts (Cosin and Patow 2022, section 4.4): what a face sends is what it sent of the light
// that the bounces began with, and what some of its patches reflect of what they see. These are picked by area, in equal steps along
// the sum of all; where there are no more than are to be picked, all are taken, by area. A thread takes a face that sends.
#include "passes/clusters/inject_clusters/part_face_types.h"
#include "passes/clusters/gather_patch.glsl"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Parts { ClusterPart data[]; } parts;
layout(scalar) readonly buffer Members { uint data[]; } members;
layout(scalar) readonly buffer PartFaces { PartFace data[]; } partFaces;
layout(scalar) readonly buffer Senders { uint data[]; } senders;
layout(scalar) readonly buffer First { uint data[]; } first;  // Radiosity of parts before the first bounce, packed.
layout(scalar) writeonly buffer Bounced { uint data[]; } bounced;  // What is added to it.
layout(scalar) writeonly buffer Sent { uint data[]; } sent;
layout(push_constant, scalar) uniform Push {
    SeenLayout lists;
    uint senderCount;
    uint picks;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.senderCount) return;
    const uint number = senders.data[i], face = number % 6u;
    const ClusterPart part = parts.data[number / 6u];
    const PartFace own = partFaces.data[number];
    const bool takesAll = own.patches <= push.picks;
    const uint picks = min(own.patches, push.picks), end = part.firstMember + part.members;
    const float step_ = own.area / float(picks), begin = step_ * toUnit(hashCombine(push.seed, number));

    // Threads that run in lockstep gather together: each finds its next patch before
    vec3 sum = vec3(0.0);
    float passed = 0.0, taken = 0.0;
    uint k = part.firstMember, side = NO_SIDE;
    for (uint pick = 0u; pick < picks; ++pick) {
        bool isFound = side != NO_SIDE && !takesAll && passed > begin + float(pick) * step_;
        for (; k < end && !isFound; ++k) {
            const uint member = members.data[k];
            if (!hasPatch(sides.data[member], face)) continue;
            side = member;
            passed += unoccluded(voxelMaterial(side), face);
            isFound = takesAll || passed > begin + float(pick) * step_;
        }
        const VoxelMaterial m = voxelMaterial(side);
        const float weight = takesAll ? unoccluded(m, face) : step_;
        sum += weight * m.albedo * gatherPatch(push.lists, patchAt(sides.data[side], face));
        taken += weight;
    }
    sum /= taken;
    bounced.data[number] = packRadiosity(sum);
    sent.data[number] = packRadiosity(unpackRadiosity(first.data[number]) + sum);
}

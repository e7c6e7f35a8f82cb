// Lists the paths that go on from the hits of cones' rays.
#include "passes/cones/gather_cones/chosen_cones.glsl"
#include "passes/path_trace/path_streams/begin_path.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Chosen { uint count; } chosen;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchCones || !isChosen(i)) return;
    if (hits.data[i].triangle == NO_HIT) {
        sums.data[i] = PathSums(vec3(0.0), 1.0e30, vec3(0.0), 0u, vec3(0.0));
        return;
    }
    atomicAdd(chosen.count, 1u);
    beginPath(i, rays.data[i], hits.data[i]);
}

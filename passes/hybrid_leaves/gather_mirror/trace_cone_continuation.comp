// Continues rays that are wider than a voxel at a surface as cones through larger voxels (Seok 2021, chapter 4: hybrid
// nodes for thin cones, mipmaps for wide ones). Light that the cone transmits is lost.
#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"
#include "passes/cones/radiance/radiance_cone.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Paths { MirrorPath data[]; } paths;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Starts { RayStart data[]; } starts;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Light { MirrorLight data[]; } light;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count || hits.data[i].triangle != HIT_IS_WIDE) return;
    const MirrorPath path = paths.data[i];
    const Ray ray = rays.data[i];

    // A cone from the ray's origin with the ray's width at t, where it starts. For a ray wider than a voxel at its
    // origin, a cone of twice the spread: it has the ray's width where the ray has doubled its width
    const float t = hits.data[i].t, spread = max(abs(path.spread), 1e-6);
    const float width = spread + path.width / max(t, path.width / spread);
    const ConeBase base = coneBase(ray.origin, starts.data[i].normal, 0.5, t);
    light.data[path.index].indirect += path.throughput * coneRadiance(base, ray.direction, width, 0.0);
}

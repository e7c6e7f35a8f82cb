// Traces a stream with ray queries, one invocation per ray.
#include "shaders/trace/trace.glsl"

layout(local_size_x = 64) in;  // STREAM_GROUP
uniform accelerationStructureEXT structure;

Hit trace(Ray ray) {
    Hit hit = Hit(ray.tMax, NO_HIT, 0.0, 0.0);
    if (!isTraceable(ray)) return hit;
    rayQueryEXT query;
    const uint flags = kOccluded ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
    rayQueryInitializeEXT(query, structure, flags, 0xff, ray.origin, ray.tMin, ray.direction, ray.tMax);

    // Only masked triangles are candidates; the query itself commits opaque ones
    while (rayQueryProceedEXT(query)) {
        const uint instance = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
        const uint primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        const vec2 barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, false);
        if (!isCutAway(instance, primitive, barycentrics)) rayQueryConfirmIntersectionEXT(query);
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return hit;
    return makeHit(ray.origin, ray.direction, rayQueryGetIntersectionTEXT(query, true),
                   uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true)),
                   uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true)),
                   rayQueryGetIntersectionBarycentricsEXT(query, true));
}

void main() {
    const uint i = call.firstRay + gl_GlobalInvocationID.x;
    if (i >= streamEnd()) return;
    storeResult(call.results, i, trace(RayStream(call.rays).data[i]));
}

#include "shaders/trace/trace.glsl"

layout(location = 0) rayPayloadInEXT Hit payload;
hitAttributeEXT vec2 barycentrics;

void main() {
    payload = makeHit(gl_WorldRayOriginEXT, gl_WorldRayDirectionEXT, gl_HitTEXT, uint(gl_InstanceCustomIndexEXT),
                      uint(gl_PrimitiveID), barycentrics);
}

#version 460
#extension GL_EXT_ray_tracing : require

#include "shaders/trace/trace.glsl"

layout(location = 0) rayPayloadInEXT Hit payload;
hitAttributeEXT vec2 barycentrics;

void main() {
    payload = makeHit(gl_WorldRayOriginEXT, gl_WorldRayDirectionEXT, gl_HitTEXT, uint(gl_InstanceCustomIndexEXT),
                      uint(gl_PrimitiveID), barycentrics);
}

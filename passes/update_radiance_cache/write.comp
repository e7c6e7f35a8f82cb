#version 460
#extension GL_GOOGLE_include_directive : require
// The irradiance of each vertex, of `bounces` bounces: its direct light, and what the vertices that follow it reflect to it. It goes
// into the vertex's cell.
#include "passes/update_radiance_cache/path_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/radiance_cache/radiance_cache.glsl"
#include "shaders/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Vertices { PathVertex data[]; } vertices;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(push_constant) uniform Push {
    uint count;
    uint bounces;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count || vertices.data[i].cell == NO_CELL) return;
    vec3 irradiance = direct.data[i].rgb, throughput = vec3(1.0);
    uint v = i;
    for (uint bounce = 0u; bounce < push.bounces; ++bounce) {
        v = vertices.data[v].next;
        if (v == NO_VERTEX) break;
        throughput *= surfels.data[v].reflectance;
        irradiance += throughput * direct.data[v].rgb;
    }
    addRadianceSample(radianceCacheGrid.data, vertices.data[i].cell, irradiance);
}

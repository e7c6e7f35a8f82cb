// Importance sampling of the environment map by luminance and solid angle: inverts CDFs of its rows and of the columns
// of a row (PBRT 12.5). Host: trace/environment_cdf.h.
#ifndef VOXRAY_ENVIRONMENT_MAP_GLSL
#define VOXRAY_ENVIRONMENT_MAP_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"

uniform sampler2D sceneEnvironmentRows;
uniform sampler2D sceneEnvironmentColumns;

// False for a constant environment.
bool hasEnvironmentMap() {
    const ivec2 size = textureSize(sceneEnvironmentColumns, 0);
    return size.x * size.y > 1;
}

// The probabilities up to interval i of a row of CDFs, without it and with it.
vec2 cdfInterval(sampler2D cdf, int row, int i) {
    return vec2(i > 0 ? texelFetch(cdf, ivec2(i - 1, row), 0).r : 0.0, texelFetch(cdf, ivec2(i, row), 0).r);
}

// The interval of a row of CDFs that holds u, and u's offset in it, 0 to 1.
int invertCdf(sampler2D cdf, int row, float u, out vec2 interval, out float offset) {
    int low = 0, high = textureSize(cdf, 0).x - 1;
    while (low < high) {
        const int center = (low + high) / 2;
        if (texelFetch(cdf, ivec2(center, row), 0).r > u) high = center;
        else low = center + 1;
    }
    interval = cdfInterval(cdf, row, low);
    offset = clamp((u - interval.x) / max(interval.y - interval.x, 1e-20), 0.0, 1.0);
    return low;
}

// Density per steradian in a texel of the map, given its row's and its column's intervals.
float texelDensity(vec2 row, vec2 column, float sinTheta) {
    const vec2 size = vec2(textureSize(sceneEnvironmentColumns, 0));
    return (row.y - row.x) * (column.y - column.x) * size.x * size.y / (2.0 * PI * PI * max(sinTheta, 1e-6));
}

// Density of sampleEnvironmentMap(), per steradian.
float environmentMapDensity(vec3 direction) {
    const ivec2 size = textureSize(sceneEnvironmentColumns, 0);
    const float sinTheta = length(direction.xz);
    const vec2 uv = vec2(0.5 + atan(direction.x, -direction.z) / (2.0 * PI), atan(sinTheta, direction.y) / PI);
    const ivec2 texel = clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1);
    return texelDensity(cdfInterval(sceneEnvironmentRows, 0, texel.y),
                        cdfInterval(sceneEnvironmentColumns, texel.y, texel.x), sinTheta);
}

// A direction towards the map, and its density per steradian.
vec3 sampleEnvironmentMap(vec2 u, out float density) {
    vec2 row, column, offset;
    const int y = invertCdf(sceneEnvironmentRows, 0, u.y, row, offset.y);
    const int x = invertCdf(sceneEnvironmentColumns, y, u.x, column, offset.x);
    const vec2 uv = (vec2(x, y) + offset) / vec2(textureSize(sceneEnvironmentColumns, 0));
    const float theta = PI * uv.y, phi = 2.0 * PI * (uv.x - 0.5), sinTheta = sin(theta);
    density = texelDensity(row, column, sinTheta);
    return vec3(sinTheta * sin(phi), cos(theta), -sinTheta * cos(phi));
}

#endif

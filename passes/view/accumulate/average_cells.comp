// Mean irradiance of each cell, an aligned square of `spacing` texels: over its first texel with rays and all others on
// the same surface.
#include "passes/view/accumulate/same_surface.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;  // W/m², number of rays.
uniform sampler2D geometricNormal;
uniform sampler2D previous;  // w: instance, 0 without a surface.
layout(rgba32f) writeonly uniform image2D cellLight;    // W/m², number of rays.
layout(rgba32f) writeonly uniform image2D cellSurface;  // Geometric normal, instance.
layout(push_constant) uniform Push { uint spacing; } push;

void main() {
    const ivec2 cell = ivec2(gl_GlobalInvocationID.xy), size = textureSize(irradiance, 0);
    if (any(greaterThanEqual(cell, imageSize(cellLight)))) return;
    const ivec2 first = cell * int(push.spacing), end = min(first + int(push.spacing), size);
    vec3 light = vec3(0.0);
    float rays = 0.0;
    vec4 surface = vec4(0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const vec4 texel = texelFetch(irradiance, ivec2(x, y), 0);
            if (texel.a <= 0.0) continue;
            const vec3 normal = texelFetch(geometricNormal, ivec2(x, y), 0).xyz;
            const float instance = texelFetch(previous, ivec2(x, y), 0).w;
            if (rays == 0.0) surface = vec4(normal, instance);
            if (instance != surface.w || !areNormalsSimilar(normal, surface.xyz)) continue;
            rays += texel.a;
            light += (texel.rgb - light) * (texel.a / rays);
        }
    imageStore(cellLight, cell, vec4(light, rays));
    imageStore(cellSurface, cell, surface);
}

// Adds this frame's irradiance to that of the frames before it. Rays count alike, whichever frame they are of, as long as there are
// no more frames than `history`: then what was kept counts as history - 1 of them.
#include "passes/view/accumulate/same_surface.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;  // W/m², number of rays.
uniform sampler2D geometricNormal;
uniform sampler2D motion;    // To where the point was seen in the frame before, texels.
uniform sampler2D previous;  // Where it was, m; instance, 0 without a surface.
#ifdef CLAMP
uniform sampler2D cellLight;
uniform sampler2D cellSurface;
#endif
uniform sampler2D historyLight;
uniform sampler2D historyPosition;
uniform sampler2D historyNormal;
layout(rgba32f) writeonly uniform image2D result;
layout(r32f) writeonly uniform image2D frames;
layout(push_constant, scalar) uniform Push {
    float history;
    float clamp_;
    uint hasHistory;
    uint spacing;
} push;

#ifdef CLAMP
#define REACH 3  // Surroundings are 7 x 7 cells.

// History within `clamp_` standard deviations of the mean of this frame's surroundings on the same surface.
vec3 clamped(vec3 light, ivec2 texel, vec3 normal, float instance) {
    const ivec2 center = texel / int(push.spacing), size = textureSize(cellLight, 0);
    vec3 origin = vec3(0.0), sum = vec3(0.0), squares = vec3(0.0);
    float rays = 0.0;
    int cells = 0;
    for (int y = max(center.y - REACH, 0); y <= min(center.y + REACH, size.y - 1); ++y)
        for (int x = max(center.x - REACH, 0); x <= min(center.x + REACH, size.x - 1); ++x) {
            const vec4 cell = texelFetch(cellLight, ivec2(x, y), 0), surface = texelFetch(cellSurface, ivec2(x, y), 0);
            if (cell.a <= 0.0 || surface.w != instance || !areNormalsSimilar(surface.xyz, normal)) continue;
            if (cells++ == 0) origin = cell.rgb;  // Sums of differences: equal values have no variance.
            const vec3 difference = cell.rgb - origin;
            sum += cell.a * difference;
            squares += cell.a * difference * difference;
            rays += cell.a;
        }
    if (cells < 2) return light;
    const vec3 mean = sum / rays, deviation = sqrt(max(squares / rays - mean * mean, 0.0));
    return clamp(light, origin + mean - push.clamp_ * deviation, origin + mean + push.clamp_ * deviation);
}
#endif

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(texel, size))) return;
    const vec4 now = texelFetch(irradiance, texel, 0), before = texelFetch(previous, texel, 0);
    const vec3 normal = texelFetch(geometricNormal, texel, 0).xyz;

    // The texels round the place where the point was seen, those that show the same surface.
    vec3 light = vec3(0.0);
    float rays = 0.0, count = 0.0, weight = 0.0;
    if (push.hasHistory != 0u && before.w > 0.0) {
        const vec2 place = vec2(texel) + texelFetch(motion, texel, 0).xy, corner = floor(place), part = place - corner;
        for (int i = 0; i < 4; ++i) {
            const ivec2 step = ivec2(i & 1, i >> 1), at = ivec2(corner) + step;
            const vec2 along = mix(1.0 - part, part, vec2(step));
            const float w = along.x * along.y;
            if (w <= 0.0 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            const vec4 position = texelFetch(historyPosition, at, 0), surface = texelFetch(historyNormal, at, 0);
            if (position.w != before.w || !areNormalsSimilar(surface.xyz, normal)) continue;
            if (!isOnSurface(before.xyz, position.xyz, surface.xyz)) continue;
            const vec4 kept = texelFetch(historyLight, at, 0);
            weight += w;
            rays += w * kept.a;
            count += w * surface.w;
            if (kept.a > 0.0) light += (kept.rgb - light) * (w * kept.a / rays);
        }
    }
    if (weight > 0.0) {
        rays /= weight;
        count /= weight;
        if (count > push.history - 1.0) {
            rays *= (push.history - 1.0) / count;
            count = push.history - 1.0;
        }
#ifdef CLAMP
        if (rays > 0.0) light = clamped(light, texel, normal, before.w);
#endif
    }

    const float all = rays + now.a;
    imageStore(result, texel, all > 0.0 ? vec4(now.rgb + (light - now.rgb) * (rays / all), all) : vec4(0.0));
    imageStore(frames, texel, vec4(count + 1.0));
}

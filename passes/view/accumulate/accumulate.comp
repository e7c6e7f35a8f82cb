// Adds this frame's irradiance to that of earlier frames, which is reprojected. The mean is over all rays of up to
// `history` frames; with more frames the history's weight is limited to that of `history` - 1 frames.
#include "passes/view/accumulate/same_surface.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;  // W/m², number of rays.
uniform sampler2D geometricNormal;
uniform sampler2D motion;    // To the point's image position in the previous frame, texels.
uniform sampler2D previous;  // The point's position in the previous frame, m; instance, 0 without a surface.
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
#define RADIUS 3  // Neighborhoods are 7 x 7 cells.

// Clamps history to `clamp_` standard deviations around the mean of this frame's neighborhood on the same surface.
vec3 clampToNeighborhood(vec3 light, ivec2 texel, vec3 normal, float instance) {
    const ivec2 center = texel / int(push.spacing), size = textureSize(cellLight, 0);
    vec3 origin = vec3(0.0), sum = vec3(0.0), squares = vec3(0.0);
    float rays = 0.0;
    int cells = 0;
    for (int y = max(center.y - RADIUS, 0); y <= min(center.y + RADIUS, size.y - 1); ++y)
        for (int x = max(center.x - RADIUS, 0); x <= min(center.x + RADIUS, size.x - 1); ++x) {
            const vec4 cell = texelFetch(cellLight, ivec2(x, y), 0), surface = texelFetch(cellSurface, ivec2(x, y), 0);
            if (cell.a <= 0.0 || surface.w != instance || !areNormalsSimilar(surface.xyz, normal)) continue;
            if (cells++ == 0) origin = cell.rgb;  // Sum differences, so that equal values have no variance
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
    const vec4 current = texelFetch(irradiance, texel, 0), point = texelFetch(previous, texel, 0);
    const vec3 normal = texelFetch(geometricNormal, texel, 0).xyz;

    // Interpolate history between texels that show the same surface
    vec3 light = vec3(0.0);
    float rays = 0.0, count = 0.0, weight = 0.0;
    if (push.hasHistory != 0u && point.w > 0.0) {
        const vec2 reprojected = vec2(texel) + texelFetch(motion, texel, 0).xy;
        const vec2 corner = floor(reprojected), fraction = reprojected - corner;
        for (int i = 0; i < 4; ++i) {
            const ivec2 offset = ivec2(i & 1, i >> 1), tap = ivec2(corner) + offset;
            const vec2 weights = mix(1.0 - fraction, fraction, vec2(offset));
            const float w = weights.x * weights.y;
            if (w <= 0.0 || any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, size))) continue;
            const vec4 position = texelFetch(historyPosition, tap, 0), surface = texelFetch(historyNormal, tap, 0);
            if (position.w != point.w || !areNormalsSimilar(surface.xyz, normal)) continue;
            if (!isOnSurface(point.xyz, position.xyz, surface.xyz)) continue;
            const vec4 history = texelFetch(historyLight, tap, 0);
            weight += w;
            rays += w * history.a;
            count += w * surface.w;
            if (history.a > 0.0) light += (history.rgb - light) * (w * history.a / rays);
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
        if (rays > 0.0) light = clampToNeighborhood(light, texel, normal, point.w);
#endif
    }

    const float total = rays + current.a;
    imageStore(result, texel,
               total > 0.0 ? vec4(current.rgb + (light - current.rgb) * (rays / total), total) : vec4(0.0));
    imageStore(frames, texel, vec4(count + 1.0));
}

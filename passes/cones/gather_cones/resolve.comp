// Reflected radiance of each pixel: albedo / pi times filtered irradiance, averaged over its texels. With SPECULAR the
// reflection of specular lobes is added, and the diffuse one scaled by what they leave to it.
//
// With KEEPS_LIGHT only the diffuse light is written, and beside it what traced texels reflect of filtered and of their
// own irradiance, summed over tiles. The two differ where albedo and irradiance change together, as with textures that
// have normal maps: the mean of their product is not the product of the means.
#include "passes/cones/radiance/texel_stride.glsl"
#include "shaders/scene/sampling.glsl"
#ifdef KEEPS_LIGHT
#include "shaders/filter/tiles.glsl"
layout(local_size_x = TILE, local_size_y = TILE) in;

layout(scalar) writeonly buffer Tiles { TileLight data[]; } tiles;  // Excess: of own irradiance over filtered.
#else
layout(local_size_x = 8, local_size_y = 8) in;
#endif

uniform sampler2D irradiance;
uniform sampler2D albedo;
uniform sampler2D position;
uniform sampler2D normal;
layout(rgba32f) writeonly uniform image2D result;
#ifdef SPECULAR
uniform sampler2D reflected;
#endif
layout(push_constant, scalar) uniform Push {
    int samples;
    int stride;
    float voxelSize;  // m
} push;

// Mean over about 25 traced texels, which averages out their cones' different directions. Weights fall with the
// distance from the tangent plane, in voxels (cones resolve no finer detail), and with the angle between the normals
// (the error bound of Ward et al. 1988).
vec3 filteredIrradiance(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
    const ivec2 size = textureSize(position, 0);
    const int reach = int(ceil(2.5 * sqrt(float(push.stride)) - 0.5));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int y = max(texel.y - reach, 0); y <= min(texel.y + reach, size.y - 1); ++y) {
        const int shift = rowShift(y, push.stride);
        const int first = (max(texel.x - reach, 0) - shift + push.stride - 1) / push.stride;
        const int last = (min(texel.x + reach, size.x - 1) - shift + push.stride) / push.stride - 1;
        for (int i = first; i <= last; ++i) {
            const ivec2 neighbor = ivec2(i * push.stride + shift, y);
            const vec4 q = texelFetch(position, neighbor, 0);
            if (q.w == 0.0) continue;
            const float angle = sqrt(max(1.0 - dot(n, normalize(texelFetch(normal, neighbor, 0).xyz)), 0.0));
            const float weight = max(1.0 - abs(dot(n, q.xyz - p.xyz)) / push.voxelSize - angle, 0.0);
            sum += weight * texelFetch(irradiance, ivec2(i, y), 0).rgb;
            weights += weight;
        }
    }
    return weights > 0.0 ? sum / weights : vec3(0.0);
}

#ifdef KEEPS_LIGHT
// Whether a texel's cones were traced, and its place among those that were.
bool isTraced(ivec2 texel, out ivec2 traced) {
    const int column = texel.x - rowShift(texel.y, push.stride);
    traced = ivec2(column / push.stride, texel.y);
    return column >= 0 && column % push.stride == 0;
}

shared vec3 kept[TILE * TILE];
shared vec3 excess[TILE * TILE];

void sumOverTile(vec3 ofMean, vec3 ofOwn) {
    const uint thread = gl_LocalInvocationIndex;
    kept[thread] = ofMean;
    excess[thread] = ofOwn - ofMean;
    for (uint half_ = uint(TILE * TILE) / 2u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (thread < half_) {
            kept[thread] += kept[thread + half_];
            excess[thread] += excess[thread + half_];
        }
    }
    const uvec2 pixels = uvec2(imageSize(result));
    if (thread == 0u)
        tiles.data[gl_WorkGroupID.y * tilesOf(pixels).x + gl_WorkGroupID.x] = TileLight(kept[0], excess[0]);
}
#endif

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    const bool isInside = all(lessThan(pixel, imageSize(result)));
    vec3 sum = vec3(0.0), ofMean = vec3(0.0), ofOwn = vec3(0.0);  // The last two of traced texels.
    for (int y = 0; isInside && y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x) {
            const ivec2 texel = pixel * push.samples + ivec2(x, y);
            vec3 color = texelFetch(albedo, texel, 0).rgb;
#ifdef SPECULAR
            const vec4 specular = texelFetch(reflected, texel, 0);
            color *= specular.a;
#endif
            const vec3 diffuse = color * filteredIrradiance(texel);
            sum += diffuse;
#ifdef KEEPS_LIGHT
            ivec2 traced;
            if (isTraced(texel, traced)) {
                ofMean += diffuse;
                ofOwn += color * texelFetch(irradiance, traced, 0).rgb;
            }
#elif defined(SPECULAR)
            sum += PI * specular.rgb;
#endif
        }
#ifdef KEEPS_LIGHT
    sumOverTile(ofMean, ofOwn);
#endif
    if (isInside) imageStore(result, pixel, vec4(sum / (PI * float(push.samples * push.samples)), 1.0));
}

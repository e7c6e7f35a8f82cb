// Indirect light of a Lambert surface by a lookup in the voxels: albedo / pi times the irradiance there.
const float kPi = 3.14159265358979;

vec3 shade(ivec2 pixel, ivec2 texel) {
    const vec4 point = texelFetch(position, texel, 0);
    if (point.w == 0.0) return vec3(0.0);  // No surface
    const vec3 facing = normalize(texelFetch(normal, texel, 0).xyz);
    return texelFetch(albedo, texel, 0).rgb / kPi * voxelIrradianceAt(point.xyz, facing);
}

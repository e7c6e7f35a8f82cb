// Adds to each measured point by how much a light's change may have changed its direct light: what the light would bring
// to it before and now, were nothing in between. A change of direction moves shadows, too; the chance that the point's
// shadow is another is taken to be half the chord between the directions, which is 0 for none and 1 for opposite ones.
#include "passes/final_gather/hit_faces/light_hit_faces/face_point.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer LightsBefore { GpuLight data[]; } lightsBefore;
layout(scalar) readonly buffer LightsNow { GpuLight data[]; } lightsNow;
layout(scalar) readonly buffer PointHits { FaceHit data[]; } pointHits;
layout(scalar) buffer PointDirect { vec4 data[]; } pointDirect;
layout(push_constant) uniform Push {
    uint points;
    uint lights;
} push;

void main() {
    const uint point = linearIndex();
    if (point >= push.points || pointDirect.data[point].w < 0.0) return;
    vec3 faceNormal_;
    const Surfel s = facePoint(pointHits.data[point], 0u, 0u, faceNormal_);
    float change = 0.0;
    for (uint i = 0u; i < push.lights; ++i) {
        const LightSample old = samplePunctual(lightsBefore.data[i], s.position);
        const LightSample now = samplePunctual(lightsNow.data[i], s.position);
        const float brought = luminance(old.irradiance) * max(dot(s.normal, old.direction), 0.0);
        const float brings = luminance(now.irradiance) * max(dot(s.normal, now.direction), 0.0);
        const float otherShadow = 0.5 * distance(old.direction, now.direction), most = max(brought, brings);
        change += sqrt((brings - brought) * (brings - brought) + otherShadow * most * most);
    }
    pointDirect.data[point].w += change;
}

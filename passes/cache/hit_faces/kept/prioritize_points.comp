// Priority of each point: by how much its update is expected to lower the squared error of the image, for each ray that
// it takes. A face's error counts as often as it is read, squared, since the rays that read it share its error. Where no
// light has changed, nothing depends on what the face's own points have measured: if dark ones stayed longer than bright
// ones, the mean would be too dark (Kirk and Arvo 1991).
#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/cache/hit_faces/kept/kept_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer PointDirect { vec4 data[]; } pointDirect;
#include "passes/cache/hit_faces/kept/direct_of_face.glsl"

layout(scalar) readonly buffer PointHits { FaceHit data[]; } pointHits;
readonly buffer MeasuredAt { uint data[]; } measuredAt;  // Frames, by point.
readonly buffer TakenSlots { uint words[]; } takenSlots;  // A bit by point: this frame has a hit to replace it.
readonly buffer Importance { uint data[]; } importance;
layout(scalar) readonly buffer MeanSquare { float value; } meanSquare;  // Of faces' irradiance, (W/m²)².
writeonly buffer Bins { uint data[]; } bins;  // By point.
buffer RaysOfBins { uint data[]; } raysOfBins;
layout(push_constant) uniform Push {
    uint faces;
    uint pointsPerFace;
    uint frame;
    uint raysOfNew;  // Of a point.
    uint raysAgain;
} push;

// By how much a new point lowers a face's mean square error. Its spread is taken to be that of all faces.
float gainOfNew(DirectOfFace d) {
    if (d.lit == 0u) return meanSquare.value;
    const float n = float(d.lit), before = d.change / d.weight, after = d.change / (d.weight + 1.0);
    return before * before - after * after + meanSquare.value / (n * (n + 1.0));
}

DirectOfFace withNew(DirectOfFace d) {
    ++d.lit;
    d.weight += 1.0;
    d.weight2 += 1.0;
    return d;
}

// With a point that is up to date in place of one that lights have changed.
DirectOfFace measuredAgain(DirectOfFace d, float change) {
    const float w = pointWeight(d, change);
    d.weight += 1.0 - w;
    d.weight2 += 1.0 - w * w;
    d.change -= w * change;
    return d;
}

uint binOf(float priority, uint class_) {
    const float middle = 0.5 * float(BINS_PER_CLASS);
    const float bin = priority > 0.0 ? middle + BINS_PER_OCTAVE * log2(priority) : 1.0;
    return class_ * BINS_PER_CLASS + uint(clamp(bin, 1.0, float(BINS_PER_CLASS - 1u)));
}

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const uint first = face * push.pointsPerFace;
    const float reads = float(importance.data[face]) / IMPORTANCE_ONE, weight = reads * reads;
    DirectOfFace d = directOfFace(first, push.pointsPerFace);  // With the updates of the points before.
    for (uint p = first; p < first + push.pointsPerFace; ++p) {
        bins.data[p] = 0u;
        if (reads == 0.0 || pointHits.data[p].face == NO_FACE) continue;
        const float change = pointDirect.data[p].w;
        uint bin, rays = push.raysOfNew;
        if (change < 0.0) {
            bin = binOf(weight * gainOfNew(d) / float(rays), d.lit == 0u && reads >= 1.0 ? CLASS_UNLIT : CLASS_ERROR);
            d = withNew(d);
        } else if (change > 0.0) {
            rays = push.raysAgain;
            const DirectOfFace after = measuredAgain(d, change);
            bin = binOf(weight * (meanSquareError(d) - meanSquareError(after)) / float(rays), CLASS_ERROR);
            d = after;
        } else if ((takenSlots.words[p >> 5] & 1u << (p & 31u)) != 0u) {
            const float n = float(d.lit), age = float(push.frame - measuredAt.data[p]);
            bin = binOf(weight * age / (n * n * float(rays)), CLASS_EXCHANGE);
        } else {
            continue;
        }
        bins.data[p] = bin;
        atomicAdd(raysOfBins.data[bin], rays);
    }
}

// Priority of each point: by how much its update is expected to lower the squared error of the image, for each ray that
// it takes. A face's error counts as often as it is read, squared, since the rays that read it share its error. Where no
// light has changed, nothing depends on what the face's own points have measured: if dark ones stayed longer than bright
// ones, the mean would be too dark (Kirk and Arvo 1991).
#include "passes/final_gather/hit_faces/light_hit_faces/face_point_types.h"
#include "passes/final_gather/hit_faces/light_hit_faces/kept/kept_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer PointDirect { vec4 data[]; } pointDirect;
#include "passes/final_gather/hit_faces/light_hit_faces/kept/direct_of_face.glsl"

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
    uint shadowRays;  // Of a point.
} push;

// By how much a new point lowers a face's mean square error. Its spread is taken to be that of all faces.
float gainOfNew(DirectOfFace d) {
    if (d.lit == 0u) return meanSquare.value;
    const float n = float(d.lit), before = d.change / d.weight, after = d.change / (d.weight + 1.0);
    return before * before - after * after + meanSquare.value / (n * (n + 1.0));
}

// With a point that is up to date in place of one that lights have changed.
DirectOfFace measuredAgain(DirectOfFace d, float change) {
    const float w = pointWeight(d, change);
    d.weight += 1.0 - w;
    d.weight2 += 1.0 - w * w;
    d.change -= w * change;
    return d;
}

uint binOf(float priority, bool lowersError) {
    const float half_ = 0.5 * float(PRIORITY_BINS);
    if (priority <= 0.0) return 0u;
    return uint(clamp(0.5 * half_ + BINS_PER_OCTAVE * log2(priority), 1.0, half_ - 1.0)) + (lowersError ? uint(half_) : 0u);
}

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const uint first = face * push.pointsPerFace;
    const float reads = float(importance.data[face]) / IMPORTANCE_ONE;
    const DirectOfFace d = directOfFace(first, push.pointsPerFace);
    const float n = float(d.lit), error = d.lit > 0u ? meanSquareError(d) : 0.0;
    for (uint p = first; p < first + push.pointsPerFace; ++p) {
        const float change = pointDirect.data[p].w;
        uint bin = 0u, rays = 0u;
        if (reads > 0.0 && pointHits.data[p].face != NO_FACE) {
            if (change < 0.0) {
                rays = push.shadowRays + 1u;
                bin = binOf(reads * reads * gainOfNew(d) / float(rays), true);
            } else if (change > 0.0) {
                rays = push.shadowRays;
                bin = binOf(reads * reads * (error - meanSquareError(measuredAgain(d, change))) / float(rays), true);
            } else if ((takenSlots.words[p >> 5] & 1u << (p & 31u)) != 0u) {
                rays = push.shadowRays + 1u;
                bin = binOf(reads * reads * float(push.frame - measuredAt.data[p]) / (n * n * float(rays)), false);
            }
        }
        bins.data[p] = bin;
        if (bin > 0u) atomicAdd(raysOfBins.data[bin], rays);
    }
}

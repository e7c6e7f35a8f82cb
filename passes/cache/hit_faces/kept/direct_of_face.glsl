// Direct light of a face by its points, some of which may be out of date. Before it is included: PointDirect, vec4 by
// point: W/m², and by how much (luminance) lights may have changed it since it was measured; below 0: not measured.
#ifndef VOXRAY_DIRECT_OF_FACE_GLSL
#define VOXRAY_DIRECT_OF_FACE_GLSL

#include "shaders/scene/sampling.glsl"

// Relative spread of direct light within a face that is taken for even: smaller ones are not told from rounding errors of
// sums of squares.
#define MIN_SPREAD 0.01

struct DirectOfFace {
    uint lit;         // Points that are measured.
    float variance;   // Of direct irradiance between points, (W/m²)².
    float scale;      // The same, with MIN_SPREAD.
    float weight;     // Sums over measured points: of their weights,
    float weight2;    // of these squared,
    float change;     // and of weight times change, W/m².
};

// Of a point by its age: its variance over its mean square error. Points that no light has changed count alike.
float pointWeight(DirectOfFace d, float change) {
    return change > 0.0 ? d.scale / (d.scale + change * change) : 1.0;
}

// Expected, of the weighted mean over points: changes of one face go together, spread is independent.
float meanSquareError(DirectOfFace d) {
    return (d.change * d.change + d.variance * d.weight2) / (d.weight * d.weight);
}

// Of points [first, first + count).
DirectOfFace directOfFace(uint first, uint count) {
    DirectOfFace d = DirectOfFace(0u, 0.0, 0.0, 0.0, 0.0, 0.0);
    float sum = 0.0, sum2 = 0.0, change2 = 0.0;
    for (uint p = first; p < first + count; ++p) {
        const vec4 direct = pointDirect.data[p];
        if (direct.w < 0.0) continue;
        const float value = luminance(direct.rgb);
        ++d.lit;
        sum += value;
        sum2 += value * value;
        change2 += direct.w * direct.w;
    }
    if (d.lit == 0u) return d;
    const float n = float(d.lit);
    // Of a single point the spread is unknown: as large as the value. What changes explain is no spread
    d.variance = d.lit == 1u ? sum2 : max((sum2 - sum * sum / n) / (n - 1.0) - change2 / n, 0.0);
    d.scale = max(d.variance, MIN_SPREAD * MIN_SPREAD * (sum2 + change2) / n);
    for (uint p = first; p < first + count; ++p) {
        const float change = pointDirect.data[p].w;
        if (change < 0.0) continue;
        const float w = pointWeight(d, change);
        d.weight += w;
        d.weight2 += w * w;
        d.change += w * change;
    }
    return d;
}

#endif

// A pixel is a sample point of a surface, one of samples² in a voxel's face: the fragment is the part of the triangle
// that the sample represents. Entry point of fragment shaders that define processFragment(), with the same functions as
// clipped_fragment.glsl.
#include "passes/common/triangle_voxelizer/grid_triangle.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"

layout(location = 0) in vec3 gridPosition;
layout(location = 1) in vec2 barycentrics;
layout(location = 2) flat in uint triangle;
layout(location = 3) flat in vec2 depths;

struct TriangleFragment {
    uint triangle;
    ivec3 voxel;  // In grid coordinates.
    vec2 barycentrics;
    uint subSamples;
};

struct ClippedFragment {
    float area;          // In units of a voxel's face.
    vec2 center;         // The sample point, as barycentric coordinates.
    uint axis;           // Of projection.
    uint subSamples;     // Sub-samples of the face across `axis` that the sample point represents.
    vec2 texCoordWidth;  // log2 of a voxel's width in texture coordinates 0 and 1.
};

// The fragment callback, defined by the including shader.
void processFragment(TriangleFragment f);

bool passesAlphaMask(TriangleFragment f) {
    const SurfacePoint s = surfacePoint(f.triangle, f.barycentrics);
    return !alphaCut(sceneMaterials.data[s.material], s);
}

// The projection along axis a sees |n_a| of the area of a triangle with unit normal n. Weighted by |n_a| / samples²
// each, the sample points of all three projections add up to the area, since n_x² + n_y² + n_z² = 1.
bool clipFragment(TriangleFragment f, out ClippedFragment c) {
    if (!passesAlphaMask(f)) return false;
    c.area = abs(surfacePoint(f.triangle, f.barycentrics).geometricNormal[voxelizer.axis]) /
             float(voxelizer.samples * voxelizer.samples);
    c.center = f.barycentrics;
    c.axis = voxelizer.axis;
    c.subSamples = f.subSamples;
    const uvec3 v = triangleVertices(f.triangle);
    const vec3 p0 = gridVertex(voxelizer.grid, v.x);
    const vec3 cross_ = cross(gridVertex(voxelizer.grid, v.y) - p0, gridVertex(voxelizer.grid, v.z) - p0);
    c.texCoordWidth = texCoordWidth(v, 0.5 * length(cross_));
    return true;
}

vec2 subSampleBarycentrics(TriangleFragment f, int bit) { return f.barycentrics; }

uvec3 subSamplesByAxis(TriangleFragment f, ClippedFragment c) {
    uvec3 byAxis = uvec3(0u);
    byAxis[c.axis] = c.subSamples;
    return byAxis;
}

// The 4x4 sub-samples of the voxel's face that are nearest to this sample point.
uint nearestSubSamples() {
    const uvec2 sample_ = uvec2(gl_FragCoord.xy) % voxelizer.samples;
    uint mask = 0u;
    for (uint bit = 0u; bit < 16u; ++bit) {
        const uvec2 nearest = (2u * uvec2(bit % 4u, bit / 4u) + 1u) * voxelizer.samples / 8u;
        if (nearest == sample_) mask |= 1u << bit;
    }
    return mask;
}

void main() {
    // Two coordinates come from the sample point, unaffected by rounding; the third from depth, which interpolation may
    // carry far beyond a triangle that is nearly edge-on.
    const uint a = voxelizer.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    ivec3 voxel;
    voxel[a] = int(floor(clamp(gridPosition[a], depths.x, depths.y)));
    voxel[b] = int(gl_FragCoord.x) / int(voxelizer.samples);
    voxel[c] = int(gl_FragCoord.y) / int(voxelizer.samples);
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(voxelizer.grid.resolution)))) return;
    processFragment(TriangleFragment(triangle, voxel, barycentrics, nearestSubSamples()));
}

// Voxel cone tracing, front to back (Crassin et al. 2011, section 7), with samples in layers of voxels rather than at
// free distances along the cone.
//
//          layer   layer     layer of a coarser level
//        |   .   |   .   |       .       |
//        |   .   |   .   |       .   ____x----->   x: a sample, where the cone's axis crosses a layer's center plane
//        |   .   |  _x---|---'''    .       |       (interpolated between the voxels of that layer)
//    o---|--_x---|-'     |       .       |
//        |   .   |   .   |       .       |
//
// Along each of the three axes the cone samples every layer of voxels that it crosses exactly once, and reads there the
// faces that oppose it along that axis. A closed surface then has an opacity of 1 wherever its voxels lie: the three
// projections of its area are each counted once. Samples at free distances would hit a wall of one voxel's thickness
// twice or not at all. Nothing behind the cone's start contributes.
#ifndef VOXRAY_RADIANCE_CONE_GLSL
#define VOXRAY_RADIANCE_CONE_GLSL

#include "passes/cones/radiance/radiance_voxels.glsl"
#include "shaders/voxels/face.glsl"

// A shader that defines CONE_RECORDS before it includes this one also defines recordCone(), which is told what a cone
// takes at each step, t metres from its start, from voxels of `level`: radiance, W/(m² sr), and opacity, the part of
// the whole cone that is occluded there.
#ifdef CONE_RECORDS
void recordCone(vec3 radiance, float opacity, float t, uint level);
#endif

// A cone ends at this transmittance.
#define MIN_TRANSMITTANCE 0.002

// Where cones start: a point of a surface.
struct ConeBase {
    vec3 position;  // m, offset from the surface by 1/256 of a voxel.
    vec3 normal;    // The surface's geometric normal, unit length.
    uint level;     // Finest level of the samples: above 0 in a clipmap's outer windows.
    float clear;    // m from the start along the cones that are known to be free of surfaces.
    // By axis: height above the surface's plane, in voxels of a sample's level, above which a sample of a layer across
    // that axis does not read the surface itself. 0 where the surface has no faces along the axis.
    vec3 clearHeight;
    // By face +x -x +y -y +z -z: radiance times opacity, and opacity, within the start's voxel, for a cone in that
    // direction.
    vec4 startVoxel[6];
};

// Radiance and opacity of a wall that stands on the surface within the start's voxel, for a cone along `face`. The
// voxel alone can't tell whether the wall is in front of the start or behind it:
//
//      in front:   o  |          behind:   |  o
//              _______|____                |______________     the surface continues in the next voxel
//
// A surface ends at a wall that stands on it: where it continues in the next voxel along `face`, the wall is behind.
vec4 wallInStartVoxel(ConeBase base, uint face) {
    const float voxel = radianceVoxelSize(base.level);
    const vec3 forward = faceNormal(face), size = abs(base.normal);
    const uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    const vec3 up = faceNormal(2u * axis + (base.normal[axis] < 0.0 ? 1u : 0u));
    const vec3 origin = radianceVoxels.grid.origin;
    const vec3 center = origin + (floor((base.position - origin) / voxel) + 0.5) * voxel;
    const vec3 inWall = mix(base.position, center, abs(forward)), inSurface = mix(inWall, center, abs(up));
    if (sampleLevel(base.level, inSurface + voxel * forward, -up).a > 0.5) return vec4(0.0);
    return sampleLevel(base.level, inWall + voxel * up, forward);
}

// `dither`, 0 to 1: between two windows of a clipmap it chooses the start level, so that the transition is gradual.
// `clear`, m: length from the start along the cones that is known to be free of surfaces; 0: unknown.
ConeBase coneBase(vec3 position, vec3 normal, float dither, float clear) {
    ConeBase base;
    base.position = position + normal * (radianceVoxels.grid.voxelSize / 256.0);
    base.normal = normal;
    base.level = startLevel(position, dither);
    base.clear = clear;

    // A sample at a layer's center reads half a voxel along the axis and, interpolated, one and a half across it.
    const vec3 size = abs(normal);
    base.clearHeight = vec3(1.5 * (size.x + size.y + size.z)) - size;
    if (radianceVoxels.grid.directions == 6u)
        base.clearHeight = mix(base.clearHeight, vec3(0.0), lessThan(size, vec3(0.1)));
    for (uint face = 0u; face < 6u; ++face)
        base.startVoxel[face] =
            clear > 0.0 || base.clearHeight[face >> 1] > 0.0 ? vec4(0.0) : wallInStartVoxel(base, face);
    return base;
}

// State of a cone along one axis. While crossing a layer the cone also moves along it, by several voxels where it is
// nearly parallel to it: then `samples` samples, evenly spaced over the crossing, count 1 / samples each.
struct ConeAxis {
    float start;  // In voxels of level 0, in the direction of travel.
    float speed;  // Voxels a metre.
    int first;    // Begin of the first layer.
    int next;     // Begin of the next layer.
    int end;      // End of the grid.
    uint level;   // Of the next layer.
    int samples;  // In the next layer.
    int sample_;  // Index of the next one of them.
    float t;      // m from the cone's start to it.
};

// What all axes of a cone share.
struct ConeShape {
    float width;   // At unit distance.
    float dither;  // Of levels, -1/2 to 1/2.
    float speed;   // Voxels a metre, of all axes together.
    float exit_;   // m from the start to where the cone leaves the grid.
    uint finest;   // The finest level that it samples.
};

void placeSample(inout ConeAxis axis) {
    const float fraction = (float(axis.sample_) + 0.5) / float(axis.samples);
    axis.t = (float(axis.next) + fraction * float(1u << axis.level) - axis.start) / axis.speed;
}

// Selects the next layer: the coarsest that begins at the end of the last one and is at most half as wide as the cone
// there, dithered by half a level. A voxel's filter, a tent two voxels wide convolved with a box of one, then has the
// variance of the cone's cross-section. `clearance`: the largest voxel, per unit of distance, whose samples don't read
// the surface that the cone starts from.
void findLayer(inout ConeAxis axis, ConeShape shape, float clearance) {
    axis.t = 1.0e30;
    const float voxel = radianceVoxels.grid.voxelSize;
    const float t = (float(axis.next) - axis.start) / axis.speed;
    if (axis.next >= axis.end || t > shape.exit_) return;
    const float largest =
        max(min(0.5 * shape.width * t * exp2(shape.dither), clearance * t), radianceVoxelSize(shape.finest));
    axis.level = min(min(uint(log2(largest / voxel)), uint(findLSB(axis.next))), radianceVoxels.grid.levels - 1u);
    axis.samples = int(ceil(0.5 * shape.speed / axis.speed));
    axis.sample_ = 0;
    placeSample(axis);
}

void advance(inout ConeAxis axis, ConeShape shape, float clearance) {
    if (++axis.sample_ < axis.samples) {
        placeSample(axis);
        return;
    }
    axis.next += 1 << axis.level;
    findLayer(axis, shape, clearance);
}

// Compositing. Opacities of samples closer to each other than a voxel's diagonal belong to one surface and add up;
// after a gap the next surface is composited behind the last one, as if independent of it.
//
// Columns. Interpolated opacities of a slanted surface add up to 1 only on average: its voxels form stairs, and a cone
// may pass between two steps.
//
//        [ ][ ]            the cone ---> passes between the voxels of the upper and the lower step,
//      -------------->     although along each column (down) the surface is closed
//              [ ][ ]
//
// Along a column of voxels, across the cone's layers, the opacities add up to exactly 1. So a sample also raises the
// opacity to that of its column: of the faces in COLUMN_LAYERS layers up to this one that oppose the cone, less those
// that face along it, which belong to what lies behind the surface. A plane of any orientation occludes 0.97, 0.99,
// 1.00 of the rays with columns of 2, 3, 4 layers.
#define COLUMN_LAYERS 3

struct ConeLight {
    vec3 radiance;
    float transmittance;  // Through the surfaces before the current one.
    float opacity;        // Of the current surface, so far; at most 1.
    float backFacing;     // Opacity of its faces along the cone, less that of the faces that oppose it.
    float blocked;        // Its opacity that is black.
    float lastT;          // m from the start to its last sample.
    vec3 column;          // By axis: opacity of the columns in the current layer, weighted by sample.
};

// Raises the current surface's opacity to `opacity` with the radiance of `value` (radiance times opacity, opacity).
void raiseOpacity(inout ConeLight light, float opacity, vec4 value) {
    const float added = min(opacity, 1.0) - light.opacity;
    if (added <= 0.0 || value.a <= 0.0) return;
    light.radiance += light.transmittance * added / value.a * value.rgb;
    light.opacity += added;
}

// Composites a sample. `front`: of the faces that oppose the cone. `back`: opacity of the faces along it. A surface
// with more back faces than front faces is seen from behind: it blocks the cone and is black. Up to an opacity of 1/2
// of back faces may belong to the stairs of a slanted surface seen from the front; the excess counts twice, so that a
// full back face blocks in full.
void addSample(inout ConeLight light, vec4 front, float back, float t, float voxel) {
    if (front.a + back <= 0.0) return;
    if (t - light.lastT > 1.75 * voxel) {
        light.transmittance *= 1.0 - light.opacity;
        light.opacity = light.backFacing = light.blocked = 0.0;
        light.column = vec3(0.0);
    }
    light.lastT = t;
    light.backFacing += back - front.a;
    const float blocked = max(clamp(2.0 * light.backFacing - 1.0, 0.0, 1.0) - light.blocked, 0.0);
    light.blocked += blocked;
    light.opacity = min(light.opacity + blocked, 1.0);
    raiseOpacity(light, light.opacity + front.a, front);
}

// Radiance that arrives at `base` through a cone along `direction` (unit, above the surface), `width` wide at unit
// distance, with levels shifted by `dither`, -1/2 to 1/2.
vec3 coneRadiance(ConeBase base, vec3 direction, float width, float dither) {
    const RadianceGrid g = radianceVoxels.grid;
    const bool faces = g.directions == 6u;
    const vec3 clearance = mix(dot(direction, base.normal) / max(base.clearHeight, 1e-6), vec3(1.0e30),
                               equal(base.clearHeight, vec3(0.0)));
    const float speed = (abs(direction.x) + abs(direction.y) + abs(direction.z)) / g.voxelSize;
    ConeShape shape = ConeShape(width, dither, speed, 1.0e30, base.level);

    // Axes are mirrored, about a multiple of the coarsest voxels' width, such that the cone travels along each in the
    // positive direction. Then the contribution of the start's voxel.
    const int coarsest = 1 << (g.levels - 1u);
    const int mirrored = (int(max(g.resolution.x, max(g.resolution.y, g.resolution.z))) + coarsest - 1) & -coarsest;
    ConeAxis axis[3];
    ConeLight light = ConeLight(vec3(0.0), 1.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0));
    for (uint k = 0u; k < 3u; ++k) {
        const bool up = direction[k] >= 0.0;
        const float inGrid = (base.position[k] - g.origin[k]) / g.voxelSize;
        const bool parallel_ = abs(direction[k]) < 1e-3;
        axis[k].start = up ? inGrid : float(mirrored) - inGrid;
        axis[k].speed = parallel_ ? 1.0 : abs(direction[k]) / g.voxelSize;
        axis[k].level = base.level;
        axis[k].next = ((int(floor(axis[k].start)) >> base.level) + 1) << base.level;
        const float reached = axis[k].start + (parallel_ ? 0.0 : axis[k].speed * base.clear);
        axis[k].next = max(axis[k].next, (int(floor(reached)) >> base.level) << base.level);
        axis[k].first = axis[k].next;
        axis[k].end = parallel_ ? axis[k].next : up ? int(g.resolution[k]) : mirrored;
        if (!parallel_) shape.exit_ = min(shape.exit_, (float(axis[k].end) - axis[k].start) / axis[k].speed);
        const vec4 startValue = abs(direction[k]) * base.startVoxel[2u * k + (up ? 0u : 1u)];
        addSample(light, startValue, 0.0, 0.0, radianceVoxelSize(base.level));
    }

    for (uint k = 0u; k < 3u; ++k) findLayer(axis[k], shape, clearance[k]);
#ifdef CONE_RECORDS
    recordCone(light.radiance, light.opacity, 0.0, base.level);
#endif

    // Each step takes the nearest sample of the three axes. There are at most one and a half samples per voxel width of
    // the path, of all axes together, and those of the first layer of an axis that the cone is nearly perpendicular to.
    const int maxSteps = 4 * int(g.resolution.x + g.resolution.y + g.resolution.z);
    for (int step_ = 0; step_ < maxSteps && light.transmittance * (1.0 - light.opacity) > MIN_TRANSMITTANCE; ++step_) {
        const uint k = axis[0].t <= axis[1].t ? (axis[0].t <= axis[2].t ? 0u : 2u) : (axis[1].t <= axis[2].t ? 1u : 2u);
        const float t = axis[k].t;
        const float voxel = radianceVoxelSize(axis[k].level);
        // The last layer may be thicker than the grid.
        if (t > shape.exit_ + 2.0 * voxel) break;
#ifdef CONE_RECORDS
        const ConeLight before = light;
        const uint level = axis[k].level;
#endif

        // Samples within the distance known to be clear are skipped. Those that may still read the surface at the start
        // don't block the cone; with one value for all faces they can't be told apart from that surface and are
        // skipped.
        const bool clear = clearance[k] * t >= voxel;
        const float sampleEnd =
            t + 0.5 * voxel / (axis[k].speed * radianceVoxels.grid.voxelSize * float(axis[k].samples));
        if ((clear || faces) && sampleEnd >= base.clear) {
            const bool up = direction[k] >= 0.0;
            const float center = float(axis[k].next) + 0.5 * float(1u << axis[k].level);
            vec3 samplePosition = base.position + t * direction;
            samplePosition[k] = g.origin[k] + (up ? center : float(mirrored) - center) * g.voxelSize;
            const vec3 forward = faceNormal(2u * k + (up ? 0u : 1u));
            const float weight = 1.0 / float(axis[k].samples);
            const bool solid = clear && faces;
            const int layers = solid ? min((axis[k].next - axis[k].first) >> axis[k].level, COLUMN_LAYERS - 1) : 0;
            vec4 column = vec4(0.0);
            float backs = 0.0;
            for (int i = 0; i <= layers; ++i) {
                const vec3 inColumn = samplePosition - float(i) * voxel * forward;
                const vec4 front = sampleLevel(axis[k].level, inColumn, forward);
                const float back = solid ? sampleLevel(axis[k].level, inColumn, -forward).a : 0.0;
                if (i == 0) addSample(light, weight * front, weight * back, t, voxel);
                column += front;
                backs += back;
                if (column.a + light.column[k] == 0.0) break;
            }
            if (solid) {
                light.column[k] += weight * clamp(column.a - backs, 0.0, 1.0);
                raiseOpacity(light, light.column[k], column);
            }
        }
#ifdef CONE_RECORDS
        recordCone(light.radiance - before.radiance,
                   before.transmittance * (1.0 - before.opacity) - light.transmittance * (1.0 - light.opacity), t,
                   level);
#endif
        if (axis[k].sample_ + 1 == axis[k].samples) light.column[k] = 0.0;
        advance(axis[k], shape, clearance[k]);
    }
    return light.radiance;
}

#endif

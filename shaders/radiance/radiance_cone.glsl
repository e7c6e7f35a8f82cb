// A cone through radiance voxels, front to back.
#ifndef VOXRAY_RADIANCE_CONE_GLSL
#define VOXRAY_RADIANCE_CONE_GLSL

#include "shaders/radiance/radiance_voxels.glsl"

// Light that what lies behind can't add visibly to.
#define MIN_TRANSMITTANCE 0.002

// Where cones start: a point of a surface.
struct ConeBase {
    vec3 position;  // m, off the surface by a trace.
    vec3 side;      // The surface's unit normal.
    uint level;     // The coarsest that describes its surroundings where no coarser one is asked for.
    // Height above the surface's plane, in voxels, from which on a sample across each axis doesn't touch it; 0 where the surface
    // shows nothing along that axis.
    vec3 reach;
    // What a cone that sets out along +x -x +y -y +z -z meets within the point's own voxel.
    vec4 beside[6];
};

vec3 faceNormal(uint face) {
    vec3 axis = vec3(0.0);
    axis[face >> 1] = (face & 1u) == 0u ? 1.0 : -1.0;
    return axis;
}

// A wall in the point's own voxel: whether it is ahead or behind is not for the voxel to tell. But a surface ends at a wall that
// stands on it: where it goes on in the next voxel, the wall is behind.
vec4 adjacentWall(ConeBase base, uint face) {
    const float voxel = radianceVoxelSize(base.level);
    const vec3 ahead = faceNormal(face), size = abs(base.side);
    const uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    const vec3 up = faceNormal(2u * axis + (base.side[axis] < 0.0 ? 1u : 0u));
    const vec3 origin = radianceVoxels.grid.origin;
    const vec3 center = origin + (floor((base.position - origin) / voxel) + 0.5) * voxel;
    const vec3 inWall = mix(base.position, center, abs(ahead)), inSurface = mix(inWall, center, abs(up));
    if (sampleLevel(base.level, inSurface + voxel * ahead, -up).a > 0.5) return vec4(0.0);
    return sampleLevel(base.level, inWall + voxel * up, ahead);
}

// `dither`, 0 to 1: where surroundings are described more and more coarsely, whether cones keep clear of the coarser voxels.
ConeBase coneBase(vec3 position, vec3 side, float dither) {
    ConeBase base;
    base.position = position + side * (radianceVoxels.grid.voxelSize / 256.0);
    base.side = side;
    base.level = startLevel(position, dither);

    // A sample reaches half a voxel along its axis and one and a half across it.
    const vec3 size = abs(side);
    base.reach = vec3(1.5 * (size.x + size.y + size.z)) - size;
    if (radianceVoxels.grid.directions == 6u) base.reach = mix(base.reach, vec3(0.0), lessThan(size, vec3(0.1)));
    for (uint face = 0u; face < 6u; ++face)
        base.beside[face] = base.reach[face >> 1] > 0.0 ? vec4(0.0) : adjacentWall(base, face);
    return base;
}

// A cone meets the sides that face it along each axis layer by layer: each layer of voxels across the axis once, in its center,
// interpolated across. So a closed surface covers it once, wherever its voxels lie, and nothing behind the cone's start, or behind
// a point that it has passed, has a say. While the cone crosses a layer it drifts along it: `samples` places share the layer's say,
// so that the covers of slanted surfaces, too, add up to 1 evenly.
struct ConeAxis {
    float start;  // In voxels of level 0, in the direction of travel.
    float speed;  // Voxels a metre.
    int first;    // Where the first layer begins.
    int next;     // Where the next one does.
    int end;      // Where the grid ends.
    uint level;   // Of the next layer.
    int samples;  // Places in it.
    int sample_;  // The next of them.
    float t;      // Metres to that.
};

// What all axes of a cone share.
struct ConeShape {
    float width;   // At unit distance.
    float dither;  // Of levels, -1/2 to 1/2.
    float speed;   // Voxels a metre, of all axes together.
    float exit_;   // Metres to where it leaves the grid.
    uint finest;   // The finest level that it asks for.
};

void placeSample(inout ConeAxis axis) {
    const float part = (float(axis.sample_) + 0.5) / float(axis.samples);
    axis.t = (float(axis.next) + part * float(1u << axis.level) - axis.start) / axis.speed;
}

// The next layer: the largest that begins where the last one ended and is no wider than half the cone there, give or take half a
// level. A voxel's filter, a tent two voxels wide over a box of one, then has the variance of the cone's cross-section. At least as
// wide as the surroundings of the cone's start are described.
// `clearance`: how wide voxels may be, at unit distance, for not to touch the surface that the cone started from.
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

// What has been collected of a cone. Surfaces that it meets within a voxel's diagonal of each other are taken for pieces of one:
// their covers add up. After a gap the next surface is hidden as if independent of the last one.
//
// Covers of slanted pieces add up to 1 on average alone: a cone steps through the surface's stairs, and may slip between two of
// them. Along one column of voxels they add up to 1 exactly. So a layer also covers the cone as far as the columns do that the cone
// crosses in it, from COLUMN_LAYERS - 1 layers before it on: what they show towards the cone less what faces away, which is what
// lies behind the surface there. Of columns of 2, 3, 4 layers a plane with any normal hides 0.97, 0.99, 1.00 of the rays.
#define COLUMN_LAYERS 3

struct ConeLight {
    vec3 radiance;
    float transmittance;  // Of the surfaces passed.
    float cover;          // Of the one that the cone is passing, at most 1.
    float behind;         // What that one shows of sides that face the way that the cone goes, less of those that face the cone.
    float blocked;        // The part of its cover that is black.
    float last;           // Metres to where the cone met it last.
    vec3 column;          // By axis: the cover of the columns that the cone has crossed in its layer, as a part of the layer's.
};

// The cone is covered up to `cover`, by what sends `met`.
void coverUpTo(inout ConeLight light, float cover, vec4 met) {
    const float added = min(cover, 1.0) - light.cover;
    if (added <= 0.0 || met.a <= 0.0) return;
    light.radiance += light.transmittance * added / met.a * met.rgb;
    light.cover += added;
}

// `met`: sides that face the cone. `back`: cover of those that face the way that it goes. A surface that shows more of these is met
// from behind: it lets nothing through, and its other side is black. Up to half a cover may belong to a slanted surface that the
// cone meets from the front; what goes beyond counts twice.
void meet(inout ConeLight light, vec4 met, float back, float t, float voxel) {
    if (met.a + back <= 0.0) return;
    if (t - light.last > 1.75 * voxel) {
        light.transmittance *= 1.0 - light.cover;
        light.cover = light.behind = light.blocked = 0.0;
        light.column = vec3(0.0);
    }
    light.last = t;
    light.behind += back - met.a;
    const float blocked = max(clamp(2.0 * light.behind - 1.0, 0.0, 1.0) - light.blocked, 0.0);
    light.blocked += blocked;
    light.cover = min(light.cover + blocked, 1.0);
    coverUpTo(light, light.cover + met.a, met);
}

// Radiance that arrives at `base` through a cone along `direction` (unit, above the surface), `width` wide at unit distance, whose
// levels are shifted by `dither`, -1/2 to 1/2.
vec3 coneRadiance(ConeBase base, vec3 direction, float width, float dither) {
    const RadianceGrid g = radianceVoxels.grid;
    const bool sides = g.directions == 6u;
    const vec3 clearance =
        mix(dot(direction, base.side) / max(base.reach, 1e-6), vec3(1.0e30), equal(base.reach, vec3(0.0)));
    const float speed = (abs(direction.x) + abs(direction.y) + abs(direction.z)) / g.voxelSize;
    ConeShape shape = ConeShape(width, dither, speed, 1.0e30, base.level);

    // Axes are turned so that the cone travels upwards along each.
    const int turned = 1 << (g.levels - 1u);
    ConeAxis axis[3];
    ConeLight light = ConeLight(vec3(0.0), 1.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0));
    for (uint k = 0u; k < 3u; ++k) {
        const bool up = direction[k] >= 0.0;
        const float inGrid = (base.position[k] - g.origin[k]) / g.voxelSize;
        const bool still = abs(direction[k]) < 1e-3;
        axis[k].start = up ? inGrid : float(turned) - inGrid;
        axis[k].speed = still ? 1.0 : abs(direction[k]) / g.voxelSize;
        axis[k].level = base.level;
        axis[k].next = ((int(floor(axis[k].start)) >> base.level) + 1) << base.level;
        axis[k].first = axis[k].next;
        axis[k].end = still ? axis[k].next : up ? int(g.resolution[k]) : turned;
        if (!still) shape.exit_ = min(shape.exit_, (float(axis[k].end) - axis[k].start) / axis[k].speed);
        const vec4 beside = abs(direction[k]) * base.beside[2u * k + (up ? 0u : 1u)];
        meet(light, beside, 0.0, 0.0, radianceVoxelSize(base.level));
    }

    for (uint k = 0u; k < 3u; ++k) findLayer(axis[k], shape, clearance[k]);

    // A step for each place of a layer: at most one and a half for each voxel's width of the way, along all axes together, and what
    // an axis that the cone is slow along has in its first layer.
    const int maxSteps = 4 * int(g.resolution.x + g.resolution.y + g.resolution.z);
    for (int step_ = 0; step_ < maxSteps && light.transmittance * (1.0 - light.cover) > MIN_TRANSMITTANCE; ++step_) {
        const uint k = axis[0].t <= axis[1].t ? (axis[0].t <= axis[2].t ? 0u : 2u) : (axis[1].t <= axis[2].t ? 1u : 2u);
        const float t = axis[k].t;
        const float voxel = radianceVoxelSize(axis[k].level);
        // The last layer may be thicker than the grid.
        if (t > shape.exit_ + 2.0 * voxel) break;

        // What may touch the cone's own surface is no reason to stop. Without sides nothing there can be told from it.
        const bool clear = clearance[k] * t >= voxel;
        if (clear || sides) {
            const bool up = direction[k] >= 0.0;
            const float center = float(axis[k].next) + 0.5 * float(1u << axis[k].level);
            vec3 place = base.position + t * direction;
            place[k] = g.origin[k] + (up ? center : float(turned) - center) * g.voxelSize;
            const vec3 ahead = faceNormal(2u * k + (up ? 0u : 1u));
            const float share = 1.0 / float(axis[k].samples);
            const bool solid = clear && sides;
            const int layers = solid ? min((axis[k].next - axis[k].first) >> axis[k].level, COLUMN_LAYERS - 1) : 0;
            vec4 column = vec4(0.0);
            float backs = 0.0;
            for (int i = 0; i <= layers; ++i) {
                const vec3 inColumn = place - float(i) * voxel * ahead;
                const vec4 front = sampleLevel(axis[k].level, inColumn, ahead);
                const float back = solid ? sampleLevel(axis[k].level, inColumn, -ahead).a : 0.0;
                if (i == 0) meet(light, share * front, share * back, t, voxel);
                column += front;
                backs += back;
                if (column.a + light.column[k] == 0.0) break;
            }
            if (solid) {
                light.column[k] += share * clamp(column.a - backs, 0.0, 1.0);
                coverUpTo(light, light.column[k], column);
            }
        }
        if (axis[k].sample_ + 1 == axis[k].samples) light.column[k] = 0.0;
        advance(axis[k], shape, clearance[k]);
    }
    return light.radiance;
}

#endif

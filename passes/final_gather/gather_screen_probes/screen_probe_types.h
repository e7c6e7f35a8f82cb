// Screen probes, shared by C++ and GLSL.
#ifndef VOXRAY_SCREEN_PROBE_TYPES_H
#define VOXRAY_SCREEN_PROBE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A point of a surface that the camera sees. Probes are listed tile by tile.
struct ScreenProbe {
    vec3 position;    // m
    float offset;     // Of ray origins along faceNormal, m.
    uint normal;      // Shading normal, octahedral.
    uint faceNormal;  // Geometric normal, octahedral.
    uint texel;       // Of the G-buffer: x, y << 16.
    uint instance;    // Mesh instance plus 1, or 0 where no motion is read.
    float width;      // Edge of a tile at its distance from the camera, m.
};

// Tiles of the G-buffer's texels.
struct ProbeTiles {
    uvec2 texels;  // Of the G-buffer.
    uvec2 tiles;   // ceil(texels / edge)
    uint edge;     // Texels along a tile's edge.
};

// What a probe receives, W/m². For a normal m that is about its own irradiance + m·tangential, by channel.
struct ProbeIrradiance {
    vec3 irradiance;
    vec3 tangentialRed;
    vec3 tangentialGreen;
    vec3 tangentialBlue;
};

VOXRAY_SHARED_END

#endif

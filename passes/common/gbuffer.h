#pragma once

#include "graph/pass.h"

namespace voxray {

/// What the camera sees, per pixel. Pixels that show no surface have position.w = 0.
struct GBuffer : Resource {
    uint32_t samples = 1;   ///< Sub-pixels along a pixel's edge: images are frame size times this.
    Image position;         ///< RGBA32F: world position in m, 1 where there is a surface.
    Image normal;           ///< RGBA16F: shading normal, turned to the camera's side.
    Image geometricNormal;  ///< RGBA16F: the triangle's normal, turned to the camera's side.
    Image albedo;           ///< RGBA16F: diffuse reflectance.
    Image
        emission;  ///< RGBA32F: radiance emitted towards the camera, W/(m² sr); the environment's on a miss.
    Image depth;   ///< D32, for the raster pass itself.

    std::vector<const Image*> checkedImages() const override {
        return {&position, &normal, &geometricNormal, &albedo, &emission};
    }
};

}  // namespace voxray

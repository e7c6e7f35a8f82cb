#pragma once

#include <glm/vec2.hpp>

#include "graph/pass.h"

namespace voxray {

/// The surfaces that the camera sees, at `samples` x `samples` texels per pixel: texel (samples x + i,
/// samples y + j) is a point in sub-pixel (i, j) of pixel (x, y). Passes that write frame images average the
/// texels of each pixel. Texels without a surface have position.w = 0.
struct GBuffer : Resource {
    uint32_t samples = 1;  ///< Texels along an edge of a pixel; known from plan() on.
    Image position;        ///< RGBA32F: world position, m; offset of ray origins along the normal, m.
    /// RGBA16F: shading normal, facing the camera. a: 1 in pixels whose texels are known to show one surface, with the
    /// same normals and material.
    Image normal;
    Image geometricNormal;  ///< RGBA16F: the triangle's normal, facing the camera.
    Image albedo;           ///< RGBA16F: diffuse reflectance.
    Image emission;         ///< RGBA32F: radiance towards the camera, W/(m² sr); the environment's on a miss.
    /// RGBA16F: F0, roughness; 0 without a specular lobe. Unpacked by specularOf() of shaders/scene/specular.glsl.
    Image specular;
    Image fresnel;  ///< RGBA8: F90, F0 and F90 of the dielectric layer; likewise.

    /// For shaders that declare images of these names, and `samples`.
    std::vector<Binding> bindings() const {
        std::vector<Binding> all{{"position", position}, {"normal", normal},     {"geometricNormal", geometricNormal},
                                 {"albedo", albedo},     {"emission", emission}, {"specular", specular},
                                 {"fresnel", fresnel},   {"samples", samples}};
        for (Binding& binding : all) binding.optional = true;
        return all;
    }
    std::vector<Aov> aovs() const override {
        return {{&position, {"P.X", "P.Y", "P.Z"}, Quantity::Other},
                {&normal, {"N.X", "N.Y", "N.Z"}, Quantity::Direction},
                {&geometricNormal, {"Ng.X", "Ng.Y", "Ng.Z"}, Quantity::Direction},
                {&albedo, {"albedo.R", "albedo.G", "albedo.B"}, Quantity::Fraction},
                {&emission, {"emission.R", "emission.G", "emission.B"}, Quantity::Radiance},
                {&specular, {"specular.R", "specular.G", "specular.B", "roughness"}, Quantity::Fraction}};
    }
    std::vector<const Image*> checkedImages() const override {
        return {&position, &normal, &geometricNormal, &albedo, &emission, &specular};
    }
};

/// Texels of a frame's G-buffer.
inline glm::uvec2 gbufferExtent(const Frame& frame, uint32_t samples) {
    return {frame.width * samples, frame.height * samples};
}

}  // namespace voxray

#pragma once

#include <glm/vec2.hpp>

#include "graph/pass.h"

namespace voxray {

/// What the camera sees: `samples` x `samples` texels a pixel. Texel (samples x + i, samples y + j) is
/// sub-pixel (i, j) of pixel (x, y), seen through its center; whoever makes an image of the frame's size from
/// it averages the texels of each pixel. Texels that show no surface have position.w = 0.
struct GBuffer : Resource {
    uint32_t samples = 1;  ///< Sub-pixels along each side of a pixel; known from plan() on.
    Image position;  ///< RGBA32F: world position in m; how far off it rays begin, 0 where there is none.
    Image normal;    ///< RGBA16F: shading normal, flipped to the camera's side.
    Image geometricNormal;  ///< RGBA16F: the triangle's normal, flipped to the camera's side.
    Image albedo;           ///< RGBA16F: diffuse reflectance.
    Image emission;  ///< RGBA32F: radiance towards the camera, W/(m² sr); the environment's on a miss.
    Image specular;  ///< RGBA16F: specular reflectance at normal incidence, roughness.
    Image fresnel;   ///< RGBA8: reflectance at grazing incidence; what diffuse light loses at normal and at
                     ///< grazing incidence. Both are read by shaders/scene/specular.glsl.

    /// Of shaders that declare its images by their names, and `samples`.
    std::vector<Binding> bindings() const {
        std::vector<Binding> all{
            {"position", position}, {"normal", normal},     {"geometricNormal", geometricNormal},
            {"albedo", albedo},     {"emission", emission}, {"specular", specular},
            {"fresnel", fresnel},   {"samples", samples}};
        for (Binding& binding : all) binding.optional = true;
        return all;
    }
    std::vector<Aov> aovs() const override {
        return {{&position, {"P.X", "P.Y", "P.Z"}},
                {&normal, {"N.X", "N.Y", "N.Z"}},
                {&geometricNormal, {"Ng.X", "Ng.Y", "Ng.Z"}},
                {&albedo, {"albedo.R", "albedo.G", "albedo.B"}},
                {&emission, {"emission.R", "emission.G", "emission.B"}},
                {&specular, {"specular.R", "specular.G", "specular.B", "roughness"}}};
    }
    std::vector<const Image*> checkedImages() const override {
        return {&position, &normal, &geometricNormal, &albedo, &emission, &specular};
    }
};

/// Texels of a frame's g-buffer.
inline glm::uvec2 gbufferExtent(const Frame& frame, uint32_t samples) {
    return {frame.width * samples, frame.height * samples};
}

}  // namespace voxray

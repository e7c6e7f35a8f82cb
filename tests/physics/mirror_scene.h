#pragma once

#include <string>
#include <utility>
#include <vector>

#include "passes/common/view/gbuffer.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

inline Material metal(const glm::vec3& color, float roughness = 0.0f) {
    Material material;
    material.baseColor = glm::vec4(color, 1.0f);
    material.roughness = roughness;
    return material;
}

/// Voxels, their light, and mirrors that read them. Direct light and composite follow where asked for.
inline std::string mirrorGraph(const std::string& mirror, const std::string& inject = "bounces: 0",
                               const std::string& before = "") {
    return graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize, resolution: 16",
                      "inject_light_rays, rays_per_light: 4096, " + inject, before, "gather_mirror, " + mirror,
                      "composite"});
}

inline double centerOf(const ImageF& image, size_t channel = 0) {
    return image.data[3 * (size_t(image.height / 2) * image.width + image.width / 2) + channel];
}

/// A mirror at z = 0 that faces the camera, and `behind` it at z = 4 a quad that faces back.
inline State facing(const Material& front, const Material& behind) {
    SceneBuilder b("facing");
    b.quad("front", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.material(front));
    b.quad("behind", {-4, -4, 4}, {0, 8, 0}, {8, 0, 0}, b.material(behind));
    b.camera({0, 0, 2}, {0, 0, 0}, 0.5f);
    return evaluated(b);
}

/// A room whose wall at -Z is of `material`, a box before it, and a point light. With one bounce the wall
/// shows what light does to the others directly.
inline State wallRoom(const Material& material, float intensity = 1.0f) {
    SceneBuilder b("wall");
    const uint32_t white = b.lambert("white", glm::vec3(0.7f)), red = b.lambert("red", {0.7f, 0.2f, 0.1f});
    const uint32_t wall = b.material(material);
    b.room({-1, 0, -1}, {1, 2, 1}, {red, white, white, white, wall, white});
    b.box("box", {0.3f, 0, 0}, {0.5f, 0.7f, 0.5f}, 0.3f, red);
    b.pointLight({-0.3f, 1.6f, 0.3f}, glm::vec3(intensity));
    b.camera({-0.2f, 1, 0.9f}, {0, 0.9f, -1}, 70);
    return evaluated(b);
}

/// Over the pixels whose surface lies at z < `depth`: mean difference from the reference over its mean, and
/// the ratio of the means.
inline std::pair<double, double> errorAt(Chain& chain, const std::string& port, const ImageF& expected, float depth) {
    const GBuffer& gbuffer = chain.get<GBuffer>("gbuffer");
    const auto positions = chain.readImage<glm::vec4>(gbuffer.position);
    const ImageF image = chain.image(port);
    const uint32_t s = gbuffer.samples, width = uint32_t(image.width);
    double difference = 0, own = 0, theirs = 0;
    for (uint32_t i = 0; i < width * uint32_t(image.height); ++i) {
        bool isThere = true;
        for (uint32_t k = 0; k < s * s; ++k)
            isThere &= positions[size_t(i / width * s + k / s) * width * s + i % width * s + k % s].z < depth;
        for (size_t channel = 3 * size_t(i); isThere && channel < 3 * size_t(i) + 3; ++channel) {
            difference += std::abs(double(image.data[channel]) - expected.data[channel]);
            own += image.data[channel];
            theirs += expected.data[channel];
        }
    }
    return {difference / theirs, own / theirs};
}

/// Light in the whole chain for wallRoom.
inline std::string roomGraph(const std::string& mirror, const std::vector<std::string>& before = {},
                             const std::string& voxels = "32") {
    std::vector<std::string> passes{"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: " + voxels,
                                    "inject_light_rays, rays_per_light: 524288, bounces: 0"};
    passes.insert(passes.end(), before.begin(), before.end());
    passes.push_back("gather_mirror, " + mirror);
    return graphYaml(passes);
}

}  // namespace voxray::test

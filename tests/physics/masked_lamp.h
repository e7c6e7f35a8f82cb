#pragma once

#include "tests/support/scenes.h"

namespace voxray::test {

/// What cuts half of a lamp away. Nothing: the twin that never had it.
enum class CutBy { Texture, NearestTexture, VertexColor, Factor, Nothing };
inline constexpr CutBy kCuts[] = {CutBy::Texture, CutBy::NearestTexture, CutBy::VertexColor, CutBy::Factor};

inline const char* nameOf(CutBy cut) {
    constexpr const char* names[] = {"texture", "nearest texture", "vertex color", "factor", "nothing"};
    return names[size_t(cut)];
}

/// A closed room of 2 m with a black lamp of 0.8 m by 0.4 m below its ceiling, which faces down; of the lamp
/// the half at x < 0 is there. The camera sees the floor.
inline State roomWithHalfALamp(CutBy cut) {
    SceneBuilder b("half a lamp");
    const uint32_t wall = b.lambert("wall", glm::vec3(0.5f));
    b.room(glm::vec3(-1), glm::vec3(1), {wall, wall, wall, wall, wall, wall});

    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec4(0, 0, 0, 1);
    lamp.metallic = lamp.specular = 0;
    lamp.emission = {3, 4, 5};
    const glm::vec3 corner(-0.4f, 0.8f, -0.2f), half(0.4f, 0, 0), depth(0, 0, 0.4f);
    if (cut == CutBy::Nothing || cut == CutBy::Factor) b.quad("lamp", corner, half, depth, b.material(lamp));
    if (cut != CutBy::Nothing) {
        lamp.alphaMode = AlphaMode::Mask;
        if (cut == CutBy::Factor) {
            lamp.baseColor.a = 0.4f;
            b.quad("gone", corner + half, half, depth, b.material(lamp));
        } else {
            b.quad("lamp", corner, 2.0f * half, depth, b.material(lamp));
        }
    }
    Scene& scene = b.scene();
    if (cut == CutBy::VertexColor)
        scene.meshes.back().colors = {glm::vec4(1), {1, 1, 1, 0}, {1, 1, 1, 0}, glm::vec4(1)};
    if (cut == CutBy::Texture || cut == CutBy::NearestTexture) {
        Texture& texture = scene.textures.emplace_back();
        texture.width = 2;
        texture.height = 1;
        texture.rgba = {255, 255, 255, 255, 255, 255, 255, 0};
        texture.wrapU = texture.wrapV = Wrap::ClampToEdge;
        texture.filter = cut == CutBy::Texture ? TexelFilter::Linear : TexelFilter::Nearest;
        scene.materials.back().baseColorTexture.texture = 0;
        scene.meshes.back().texCoords0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    }
    b.camera({0, -0.2f, 0.9f}, {0, -1, 0}, 70);
    return evaluated(b);
}

}  // namespace voxray::test

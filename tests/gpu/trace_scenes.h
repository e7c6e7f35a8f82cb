#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "scene/geometry.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Uniform random numbers of a fixed seed.
class TestRandom {
 public:
    explicit TestRandom(uint32_t seed) : engine_(seed) {}
    float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    glm::vec3 vector(float low, float high) {
        const float x = (*this)(low, high), y = (*this)(low, high), z = (*this)(low, high);
        return {x, y, z};
    }

 private:
    std::mt19937 engine_;
};

/// Opaque, masked (by a texture of each wrap mode, one of them not filtered, by vertex alpha) and blended
/// materials.
inline std::shared_ptr<Scene> soupMaterials(TestRandom& random) {
    auto scene = std::make_shared<Scene>();
    scene->materials.emplace_back();
    for (Wrap wrap : {Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat}) {
        Texture texture;
        texture.width = 13;
        texture.height = 7;
        texture.srgb = true;
        texture.wrapU = texture.wrapV = wrap;
        if (wrap == Wrap::MirroredRepeat) texture.filter = TexelFilter::Nearest;
        for (uint32_t i = 0; i < 4 * 13 * 7; ++i) texture.rgba.push_back(uint8_t(random(0, 255.99f)));
        Material material;
        material.alphaMode = AlphaMode::Mask;
        material.alphaCutoff = 0.4f;
        material.baseColor.a = 0.9f;
        material.baseColorTexture.texture = int32_t(scene->textures.size());
        material.baseColorTexture.texCoord = uint32_t(scene->textures.size() % 2);
        material.baseColorTexture.transform = {glm::vec3(1.5f, 0.25f, 0.1f), glm::vec3(-0.25f, 2.0f, 0.3f)};
        scene->textures.push_back(std::move(texture));
        scene->materials.push_back(material);
    }
    Material byVertex;
    byVertex.alphaMode = AlphaMode::Mask;
    scene->materials.push_back(byVertex);
    Material blended;
    blended.alphaMode = AlphaMode::Blend;
    blended.baseColor.a = 0.1f;
    scene->materials.push_back(blended);
    return scene;
}

/// `count` random triangles of random materials in [-1, 1]³; every 50th is degenerate.
inline SceneState triangleSoup(uint32_t count, float size, uint32_t seed) {
    TestRandom random(seed);
    const std::shared_ptr<Scene> scene = soupMaterials(random);
    SceneState state;
    state.scene = scene;
    for (uint32_t t = 0; t < count; ++t) {
        const glm::vec3 center = random.vector(-1, 1);
        for (uint32_t corner = 0; corner < 3; ++corner) {
            state.geometry.positions.push_back(center + random.vector(-size, size));
            VertexAttributes vertex;
            for (int i = 0; i < 4; ++i) vertex.texCoords[i] = random(-1.5f, 1.5f);
            vertex.color.a = random(0, 1);
            state.geometry.attributes.push_back(vertex);
        }
        const uint32_t first = 3 * t;
        if (t % 50 == 49) state.geometry.positions[first + 1] = state.geometry.positions[first];
        state.geometry.triangles.emplace_back(first, first + 1, first + 2);
        state.geometry.triangleMaterials.push_back(uint32_t(random(0, float(scene->materials.size()) - 0.001f)));
    }
    state.geometry.boundsMin = glm::vec3(-1 - size);
    state.geometry.boundsMax = glm::vec3(1 + size);
    state.geometry.region = {state.geometry.boundsMin, state.geometry.boundsMax};
    return state;
}

/// One triangle (0,0,0) (1,0,0) (0,1,0), facing +Z.
inline SceneState oneTriangle() {
    SceneState state;
    auto scene = std::make_shared<Scene>();
    scene->materials.emplace_back();
    state.scene = scene;
    state.geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    state.geometry.attributes.resize(3);
    state.geometry.triangles = {{0, 1, 2}};
    state.geometry.triangleMaterials = {0};
    state.geometry.boundsMax = {1, 1, 0};
    state.geometry.region = {state.geometry.boundsMin, state.geometry.boundsMax};
    return state;
}

/// A masked square of 1 m that faces +Z, with one alpha everywhere: a texture's code times factor times
/// vertex color. The cutoff is that product.
inline SceneState alphaAtCutoff(uint8_t code, double factor, double vertex) {
    SceneState state = oneTriangle();
    auto scene = std::make_shared<Scene>();
    Texture& texture = scene->textures.emplace_back();
    texture.width = 3;
    texture.height = 2;
    for (int i = 0; i < 24; ++i) texture.rgba.push_back(i % 4 == 3 ? code : 255);
    Material& material = scene->materials.emplace_back();
    material.alphaMode = AlphaMode::Mask;
    material.alphaCutoff = float(factor * vertex * code / 255);
    material.baseColor.a = float(factor);
    material.baseColorTexture.texture = 0;
    state.scene = scene;
    state.geometry.positions.emplace_back(1, 1, 0);
    state.geometry.attributes.resize(4);
    for (uint32_t i = 0; i < 4; ++i) {
        state.geometry.attributes[i].color.a = float(vertex);
        state.geometry.attributes[i].texCoords = glm::vec4(state.geometry.positions[i], 0) * 2.7f;
    }
    state.geometry.triangles.emplace_back(1, 3, 2);
    state.geometry.triangleMaterials.push_back(0);
    state.geometry.boundsMax = {1, 1, 0};
    state.geometry.region = {state.geometry.boundsMin, state.geometry.boundsMax};
    return state;
}

inline SceneState emptyScene() {
    SceneState state = oneTriangle();
    state.geometry = {};
    return state;
}

/// Rays from everywhere to everywhere, with directions of many lengths; every seventh ends early.
inline std::vector<Ray> randomRays(uint32_t count, uint32_t seed) {
    TestRandom random(seed);
    std::vector<Ray> rays(count);
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 origin = random.vector(-2, 2), target = random.vector(-1, 1);
        const float scale = random(0.25f, 4.0f);
        const float tMax = i % 7 == 0 ? random(0.0f, 1.0f) : std::numeric_limits<float>::infinity();
        rays[i] = {origin, 1e-4f, (target - origin) * scale, tMax};
    }
    return rays;
}

}  // namespace voxray

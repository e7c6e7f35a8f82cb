#pragma once

#include <memory>
#include <vector>

#include "scene/geometry.h"
#include "vulkan/commands.h"
#include "vulkan/memory.h"

namespace voxray {

/// A scene's triangles, materials, textures and lights on the device, as shaders/scene/scene.glsl reads them
/// (structs: shaders/scene/scene_types.h). Triangle numbers are those of Geometry.
struct GpuScene {
    Buffer positions;          ///< 3 floats a vertex, tightly packed.
    Buffer attributes;         ///< VertexAttributes a vertex.
    Buffer triangles;          ///< 3 uints a triangle.
    Buffer triangleMaterials;  ///< 1 uint a triangle.
    Buffer geometry;           ///< The addresses of these four, which is what shaders are given.
    Buffer materials;          ///< GpuMaterial each.
    Buffer lights;             ///< GpuLight each; at least one element is allocated.
    Buffer emitters;           ///< GpuEmitter each: emissive triangles; at least one element is allocated.
    TextureArray textures;     ///< All with full mip chains.
    Image environment;         ///< Equirectangular radiance, 1x1 for a constant one; black without one.
    Sampler environmentSampler;

    uint32_t triangleCount = 0;
    uint32_t lightCount = 0;
    uint32_t emitterCount = 0;
    bool hasEnvironment = false;

    std::unique_ptr<GpuScene> panes;  ///< Of the state's, where they dim light; else nullptr.

    std::vector<Image> images;
    std::vector<Sampler> samplers;

    /// The bindings that a shader including files of shaders/scene may use, followed by `more`.
    std::vector<Binding> bindings(std::vector<Binding> more = {}) const;
    std::vector<Binding> bindings(std::initializer_list<Binding> more) const {
        return bindings(std::vector<Binding>(more));
    }
};

/// Bytes that makeGpuScene will allocate, but for the environment.
uint64_t gpuSceneBytes(const SceneState& state);
/// Those of its textures, and those of its environment.
uint64_t gpuTextureBytes(const Scene& scene);
uint64_t gpuEnvironmentBytes(const Environment& environment);

/// Uploads a scene; nothing where there is no Vulkan. @throws Error over the memory limit, or for more
/// textures than the device can bind.
GpuScene makeGpuScene(Device& device, CommandStream& stream, const SceneState& state);

/// Takes over where the state's moving instances and its lights are now (`advance`), in place.
void updateGpuScene(CommandStream& stream, const SceneState& state, GpuScene& scene);

}  // namespace voxray

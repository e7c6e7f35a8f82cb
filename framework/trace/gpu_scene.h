#pragma once

#include <memory>
#include <vector>

#include "scene/geometry.h"
#include "shaders/scene/scene_types.h"
#include "vulkan/commands.h"
#include "vulkan/memory.h"

namespace voxray {

/// A scene's triangles, materials, textures and lights on the device, as shaders/scene/scene.glsl reads them
/// (structs: shaders/scene/scene_types.h). Triangle numbers are those of Geometry.
struct GpuScene {
    Buffer positions;          ///< 3 floats per vertex, tightly packed.
    Buffer attributes;         ///< VertexAttributes per vertex.
    Buffer triangles;          ///< 3 uints per triangle.
    Buffer triangleMaterials;  ///< 1 uint per triangle.
    Buffer geometry;           ///< Addresses of these four, for shaders.
    Buffer materials;          ///< GpuMaterial.
    Buffer lights;             ///< GpuLight; at least one element.
    Buffer emitters;           ///< GpuEmitter: emissive triangles; at least one element.
    Buffer lightTree;          ///< LightTreeNode: over emitters, and point and spot lights; at least one element.
    TextureArray textures;     ///< All with full mip chains.
    Image environment;         ///< Equirectangular radiance, 1x1 for a constant one; black without one.
    Sampler environmentSampler;
    Image environmentRows;     ///< EnvironmentCdf::rows, as one row; one texel without a map.
    Image environmentColumns;  ///< EnvironmentCdf::columns; one texel without a map.

    uint32_t triangleCount = 0;
    uint32_t lightCount = 0;
    uint32_t emitterCount = 0;
    /// Subtree of the emitters: the root, or its first child where there are punctual lights, too.
    uint32_t emitterRoot = 0;
    bool hasEnvironment = false;

    std::unique_ptr<GpuScene> panes;  ///< SceneState::panes if they dim light, else nullptr.

    std::vector<gpu::GpuLight> uploadedLights;  ///< What `lights` holds.

    std::vector<Image> images;
    std::vector<Sampler> samplers;

    /// Bindings of shaders/scene.
    std::vector<Binding> bindings() const;
};

/// Bytes that makeGpuScene allocates, without the environment.
uint64_t gpuSceneBytes(const SceneState& state);
/// Bytes of textures, and of the environment with its distribution.
uint64_t gpuTextureBytes(const Scene& scene);
uint64_t gpuEnvironmentBytes(const Environment& environment);

/// Uploads a scene; empty without Vulkan. @throws Error over the memory limit, or for more textures than the
/// device can bind.
GpuScene makeGpuScene(Device& device, CommandStream& stream, const SceneState& state);

/// Uploads the state's current moving instances and lights (`advance`), in place.
void updateGpuScene(CommandStream& stream, const SceneState& state, GpuScene& scene);

}  // namespace voxray

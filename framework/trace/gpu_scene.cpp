#include "trace/gpu_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "scene/light_tree.h"
#include "scene/luminance.h"
#include "scene/panes.h"
#include "shaders/scene/scene_types.h"
#include "trace/emission.h"
#include "trace/environment_cdf.h"
#include "trace/texture_lookup.h"
#include "trace/uploaded.h"

namespace voxray {
namespace {

static_assert(sizeof(gpu::GpuVertexAttributes) == sizeof(VertexAttributes));

struct GpuSceneGeometry {  // Device addresses, as in SceneGeometry of shaders/scene/scene.glsl.
    uint64_t positions, attributes, triangles, triangleMaterials;
};

static_assert(uint32_t(Wrap::Repeat) == WRAP_REPEAT && uint32_t(Wrap::ClampToEdge) == WRAP_CLAMP &&
              uint32_t(Wrap::MirroredRepeat) == WRAP_MIRROR);
static_assert(uint32_t(TexelFilter::Linear) == FILTER_LINEAR && uint32_t(TexelFilter::Nearest) == FILTER_NEAREST);

gpu::GpuTextureRef toGpu(const Scene& scene, const TextureRef& ref) {
    if (ref.texture < 0) return {NO_TEXTURE, ref.texCoord, ref.transform[0], ref.transform[1], 0, 0, 0, {}};
    const Texture& texture = scene.textures[size_t(ref.texture)];
    return {uint32_t(ref.texture),    ref.texCoord,
            ref.transform[0],         ref.transform[1],
            uint32_t(texture.wrapU),  uint32_t(texture.wrapV),
            uint32_t(texture.filter), {texture.width, texture.height}};
}

gpu::GpuMaterial toGpu(const Scene& scene, const Material& m) {
    gpu::GpuMaterial out{};
    out.baseColor = m.baseColor;
    out.emission = m.emission;
    out.metallic = m.metallic;
    out.specularColor = m.specularColor;
    out.roughness = m.roughness;
    out.specular = m.specular;
    out.ior = m.ior;
    out.normalScale = m.normalScale;
    out.transmission = m.transmission;
    out.alphaThreshold = alphaThreshold(m);
    out.alphaMode = uint32_t(m.alphaMode);
    out.doubleSided = m.doubleSided ? 1u : 0u;
    out.baseColorTexture = toGpu(scene, m.baseColorTexture);
    out.metallicRoughnessTexture = toGpu(scene, m.metallicRoughnessTexture);
    out.normalTexture = toGpu(scene, m.normalTexture);
    out.emissiveTexture = toGpu(scene, m.emissiveTexture);
    return out;
}

gpu::GpuLight toGpu(const Light& light) {
    return {light.intensity, uint32_t(light.type),          light.position, std::cos(light.innerConeAngle),
            light.direction, std::cos(light.outerConeAngle)};
}

// Emissive triangles with their sampling probabilities, proportional to power, and as lights of a tree.
struct Emitters {
    std::vector<gpu::GpuEmitter> all;
    std::vector<BoundedLight> bounded;
};
Emitters findEmitters(const SceneState& state) {
    const Geometry& g = state.geometry;
    Emitters emitters;
    std::vector<double> powers;
    double total = 0;
    for (uint32_t t = 0; t < g.triangles.size(); ++t) {
        const float radiance = luminance(meanEmission(state, t));
        if (!(radiance > 0)) continue;
        const glm::uvec3 v = g.triangles[t];
        const glm::vec3 corners[] = {g.positions[v.x], g.positions[v.y], g.positions[v.z]};
        const glm::vec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const float area = 0.5f * glm::length(across);
        if (!(area > 0)) continue;
        const bool doubleSided = state.scene->materials[g.triangleMaterials[t]].doubleSided;
        emitters.bounded.push_back(boundedLight(corners, glm::normalize(across), double(area), double(radiance),
                                                doubleSided, uint32_t(emitters.all.size())));
        emitters.all.push_back({t, area, 0, 0, 0});
        powers.push_back(double(radiance) * area * 3.14159265358979 * (doubleSided ? 2 : 1));
        total += powers.back();
    }
    double running = 0;
    for (size_t i = 0; i < emitters.all.size(); ++i) {
        running += powers[i];
        emitters.all[i].probability = float(powers[i] / total);
        emitters.all[i].cumulativePower = i + 1 == emitters.all.size() ? 1.0f : float(running / total);
    }
    return emitters;
}

// Returns whether lights differ from those that were uploaded before.
bool uploadLights(CommandStream& stream, const SceneState& state, GpuScene& scene) {
    std::vector<gpu::GpuLight> lights;
    for (const Light& light : state.lights) lights.push_back(toGpu(light));
    const auto bytes = std::as_bytes(std::span(lights)), before = std::as_bytes(std::span(scene.uploadedLights));
    if (std::ranges::equal(bytes, before)) return false;
    stream.upload(scene.lights, lights);
    scene.uploadedLights = std::move(lights);
    return true;
}

// Emitters, and the tree over these and punctual lights.
void uploadLightTree(CommandStream& stream, const SceneState& state, GpuScene& scene) {
    Emitters emitters = findEmitters(state);
    std::vector<BoundedLight>& bounded = emitters.bounded;
    const size_t emitterCount = bounded.size();
    for (uint32_t i = 0; i < state.lights.size(); ++i)
        if (const auto light = boundedLight(state.lights[i], LIGHT_TREE_PUNCTUAL | i)) bounded.push_back(*light);
    const LightTree tree(bounded, emitterCount);
    for (size_t i = 0; i < emitterCount; ++i) emitters.all[i].leaf = tree.leaf(i);
    const auto upload = [&]<typename T>(const Buffer& to, std::vector<T> elements) {
        elements.resize(to.bytes() / sizeof(T));  // Nothing is left of a larger tree that was there
        stream.upload(to, elements);
    };
    upload(scene.emitters, emitters.all);
    upload(scene.lightTree, tree.nodes());
    scene.emitterCount = uint32_t(emitterCount);
    scene.emitterRoot = emitterCount > 0 && emitterCount < bounded.size() ? 1 : 0;
}

uint64_t emissiveTriangles(const SceneState& state) {
    uint64_t count = 0;
    for (uint32_t t = 0; t < state.geometry.triangles.size(); ++t) count += canEmit(state, t);
    return count;
}

struct LightBytes {
    uint64_t lights, emitters, tree;
    uint64_t all() const { return lights + emitters + tree; }
};
LightBytes lightBytes(const SceneState& state) {
    const uint64_t lights = state.lights.size(), emitters = emissiveTriangles(state);
    return {std::max<uint64_t>(lights, 1) * sizeof(gpu::GpuLight),
            std::max<uint64_t>(emitters, 1) * sizeof(gpu::GpuEmitter),
            lightTreeNodes(lights + emitters) * sizeof(gpu::LightTreeNode)};
}

bool emittersMove(const SceneState& state) {
    for (const InstanceRange& run : movingInstanceRanges(state.geometry))
        for (uint32_t t = run.firstTriangle; t < run.firstTriangle + run.triangleCount; ++t)
            if (canEmit(state, t)) return true;
    return false;
}

VkSamplerAddressMode toVulkan(Wrap wrap) {
    return wrap == Wrap::ClampToEdge      ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE
           : wrap == Wrap::MirroredRepeat ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                          : VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

ImageDesc describe(const Texture& texture) {
    return {.format = texture.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
            .extent = {texture.width, texture.height, 1},
            .mipLevels = uint32_t(std::bit_width(std::max(texture.width, texture.height))),
            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
}

Image uploadedTexture(Device& device, CommandStream& stream, const Texture& texture) {
    Image image(device, "texture " + texture.name, describe(texture));
    stream.upload(image, std::as_bytes(std::span(texture.rgba)));
    if (image.desc().mipLevels > 1) stream.makeMipLevels(image);
    stream.finish();
    return image;
}

// The environment's radiance, its scale baked in. RGBA32F.
ImageF environmentImage(const Environment& environment) {
    if (!environment.map) {
        ImageF constant(1, 1, 4, 1.0f);
        for (int c = 0; c < 3; ++c) constant.data[size_t(c)] = environment.radiance[c];
        return constant;
    }
    const ImageF& map = *environment.map;
    ImageF scaled(map.width, map.height, 4, 1.0f);
    for (size_t i = 0; i < map.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c)
            scaled.data[4 * i + c] = map.data[map.channels * i + c] * environment.radiance[int(c)];
    return scaled;
}

Image uploadedFloats(Device& device, CommandStream& stream, const char* name, const glm::uvec3& extent,
                     const std::vector<float>& values) {
    Image image(device, name, {.format = VK_FORMAT_R32_SFLOAT, .extent = extent});
    stream.upload(image, std::as_bytes(std::span(values)));
    return image;
}

}  // namespace

uint64_t gpuSceneBytes(const SceneState& state) {
    const Geometry& g = state.geometry;
    const uint64_t bytes = g.positions.size() * (sizeof(glm::vec3) + sizeof(VertexAttributes)) +
                           g.triangles.size() * (sizeof(glm::uvec3) + sizeof(uint32_t)) +
                           state.scene->materials.size() * sizeof(gpu::GpuMaterial) + lightBytes(state).all();
    return bytes + gpuTextureBytes(*state.scene) + (dimsLight(state) ? gpuSceneBytes(*state.panes) : 0);
}

uint64_t gpuTextureBytes(const Scene& scene) {
    uint64_t bytes = 0;
    for (const Texture& texture : scene.textures) bytes += imageBytes(describe(texture));
    return bytes;
}

uint64_t gpuEnvironmentBytes(const Environment& environment) {
    ImageDesc desc;
    if (environment.map) desc.extent = {environment.map->width, environment.map->height, 1};
    const ImageDesc columns{VK_FORMAT_R32_SFLOAT, desc.extent};
    const ImageDesc rows{VK_FORMAT_R32_SFLOAT, {desc.extent.y, 1, 1}};
    return imageBytes(desc) + imageBytes(columns) + imageBytes(rows);
}

std::vector<Binding> GpuScene::bindings() const {
    return {ifUsed({"sceneGeometry", geometry}),
            ifUsed({"sceneMaterials", materials}),
            ifUsed({"sceneLights", lights}),
            ifUsed({"sceneEmitters", emitters}),
            ifUsed({"sceneLightTree", lightTree}),
            ifUsed({"sceneTextures", textures}),
            ifUsed({"sceneEnvironment", environment, environmentSampler}),
            ifUsed({"sceneEnvironmentRows", environmentRows}),
            ifUsed({"sceneEnvironmentColumns", environmentColumns})};
}

GpuScene makeGpuScene(Device& device, CommandStream& stream, const SceneState& state) {
    const Geometry& g = state.geometry;
    GpuScene scene;
    if (device.isHost()) return scene;

    // Geometry.
    scene.positions = uploaded(device, stream, "scene positions", g.positions);
    scene.attributes = uploaded(device, stream, "scene attributes", g.attributes);
    scene.triangles = uploaded(device, stream, "scene triangles", g.triangles);
    scene.triangleMaterials = uploaded(device, stream, "scene triangle materials", g.triangleMaterials);
    scene.geometry =
        uploaded(device, stream, "scene geometry",
                 std::vector<GpuSceneGeometry>{{scene.positions.address(), scene.attributes.address(),
                                                scene.triangles.address(), scene.triangleMaterials.address()}});
    scene.triangleCount = uint32_t(g.triangles.size());

    // Materials and lights.
    std::vector<gpu::GpuMaterial> materials;
    for (const Material& material : state.scene->materials) materials.push_back(toGpu(*state.scene, material));
    scene.materials = uploaded(device, stream, "scene materials", materials);
    scene.lightCount = uint32_t(state.lights.size());
    const LightBytes bytes = lightBytes(state);
    scene.lights = Buffer(device, "scene lights", bytes.lights);
    scene.emitters = Buffer(device, "scene emitters", bytes.emitters);
    scene.lightTree = Buffer(device, "light tree", bytes.tree);
    uploadLights(stream, state, scene);
    uploadLightTree(stream, state, scene);

    // The environment.
    const ImageF environment = environmentImage(state.scene->environment);
    scene.environment = Image(device, "environment", {.extent = {environment.width, environment.height, 1}});
    scene.environmentSampler =
        Sampler(device, Filter::Linear, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    stream.upload(scene.environment, std::as_bytes(std::span(environment.data)));
    scene.hasEnvironment = state.scene->environment.radiance != glm::vec3(0.0f);
    EnvironmentCdf cdf = environmentCdf(state.scene->environment);
    if (cdf.width == 0) cdf = {1, 1, {1.0f}, {1.0f}};
    scene.environmentRows = uploadedFloats(device, stream, "environment rows", {cdf.height, 1, 1}, cdf.rows);
    scene.environmentColumns =
        uploadedFloats(device, stream, "environment columns", {cdf.width, cdf.height, 1}, cdf.columns);

    // Textures with mip levels; one white texel for a scene without textures.
    std::vector<TextureArray::Entry> entries;
    const Texture white{.name = "white", .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
    const std::vector<Texture> none{white};
    const std::vector<Texture>& textures = state.scene->textures.empty() ? none : state.scene->textures;
    for (const Texture& texture : textures) {
        scene.images.push_back(uploadedTexture(device, stream, texture));
        scene.samplers.emplace_back(device, texture.filter == TexelFilter::Nearest ? Filter::Nearest : Filter::Linear,
                                    toVulkan(texture.wrapU), toVulkan(texture.wrapV));
    }
    for (size_t i = 0; i < scene.images.size(); ++i) entries.push_back({&scene.images[i], &scene.samplers[i]});
    scene.textures = TextureArray(device, entries);
    if (dimsLight(state)) scene.panes = std::make_unique<GpuScene>(makeGpuScene(device, stream, *state.panes));
    stream.finish();
    return scene;
}

void updateGpuScene(CommandStream& stream, const SceneState& state, GpuScene& scene) {
    if (stream.device().isHost()) return;
    const Geometry& g = state.geometry;
    const auto upload = [&](const Buffer& to, const auto& elements, uint32_t first, uint32_t count) {
        stream.upload(to, std::as_bytes(std::span(elements).subspan(first, count)), first * sizeof(elements[0]));
    };
    for (const InstanceRange& run : movingInstanceRanges(g)) {
        upload(scene.positions, g.positions, run.firstVertex, run.vertexCount);
        upload(scene.attributes, g.attributes, run.firstVertex, run.vertexCount);
        upload(scene.triangles, g.triangles, run.firstTriangle, run.triangleCount);
    }
    const bool lightsChanged = uploadLights(stream, state, scene);
    if (lightsChanged || emittersMove(state)) uploadLightTree(stream, state, scene);
    if (scene.panes) updateGpuScene(stream, *state.panes, *scene.panes);
}

}  // namespace voxray

#include "scene/content_hash.h"

#include "base/files.h"

namespace voxray {
namespace {

template <typename T>
void addArray(Hasher& hash, const std::vector<T>& values) {
    hash.addPlain(uint64_t(values.size()));
    if (!values.empty()) hash.add(values.data(), values.size() * sizeof(T));
}

void add(Hasher& hash, const TextureRef& ref) {
    hash.addPlain(ref.texture).addPlain(ref.texCoord).addPlain(ref.transform);
}

void add(Hasher& hash, const Texture& texture) {
    hash.add(texture.name).addPlain(texture.width).addPlain(texture.height);
    addArray(hash, texture.rgba);
    hash.addPlain(texture.srgb).addPlain(texture.wrapU).addPlain(texture.wrapV);
    hash.addPlain(texture.filter);
}

void add(Hasher& hash, const Material& m) {
    hash.add(m.name).addPlain(m.baseColor).addPlain(m.metallic).addPlain(m.roughness);
    hash.addPlain(m.specular).addPlain(m.specularColor).addPlain(m.ior).addPlain(m.emission);
    hash.addPlain(m.transmission);
    hash.addPlain(m.normalScale).addPlain(m.alphaMode).addPlain(m.alphaCutoff).addPlain(m.doubleSided);
    for (const TextureRef* ref :
         {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissiveTexture})
        add(hash, *ref);
}

void add(Hasher& hash, const Mesh& mesh) {
    hash.add(mesh.name).addPlain(mesh.material);
    addArray(hash, mesh.positions);
    addArray(hash, mesh.normals);
    addArray(hash, mesh.tangents);
    addArray(hash, mesh.texCoords0);
    addArray(hash, mesh.texCoords1);
    addArray(hash, mesh.colors);
    for (const SkinWeights& set : mesh.skinWeights) {
        addArray(hash, set.joints);
        addArray(hash, set.weights);
    }
    addArray(hash, mesh.triangles);
}

void add(Hasher& hash, const Node& node) {
    hash.add(node.name).addPlain(node.parent).addPlain(node.translation);
    hash.addPlain(node.rotation.x)
        .addPlain(node.rotation.y)
        .addPlain(node.rotation.z)
        .addPlain(node.rotation.w);
    hash.addPlain(node.scale).addPlain(node.matrix.has_value());
    if (node.matrix) hash.addPlain(*node.matrix);
}

void add(Hasher& hash, const Skin& skin) {
    addArray(hash, skin.joints);
    addArray(hash, skin.inverseBindMatrices);
}

void add(Hasher& hash, const Instance& instance) {
    hash.addPlain(instance.mesh).addPlain(instance.node).addPlain(instance.skin);
}

void add(Hasher& hash, const Light& light) {
    hash.add(light.name).addPlain(light.type).addPlain(light.intensity);
    hash.addPlain(light.innerConeAngle).addPlain(light.outerConeAngle);
    hash.addPlain(light.position).addPlain(light.direction).addPlain(light.node);
}

void add(Hasher& hash, const Camera& camera) {
    hash.add(camera.name).addPlain(camera.verticalFovRadians).addPlain(camera.position);
    hash.addPlain(camera.forward).addPlain(camera.up).addPlain(camera.node);
}

void add(Hasher& hash, const Environment& environment) {
    hash.addPlain(environment.radiance).addPlain(environment.map != nullptr);
    if (!environment.map) return;
    hash.addPlain(environment.map->width)
        .addPlain(environment.map->height)
        .addPlain(environment.map->channels);
    addArray(hash, environment.map->data);
}

void add(Hasher& hash, const AnimationChannel& channel) {
    hash.addPlain(channel.node).addPlain(channel.property).addPlain(channel.interpolation);
    addArray(hash, channel.timesSeconds);
    addArray(hash, channel.values);
}

template <typename T>
void addAll(Hasher& hash, const std::vector<T>& values) {
    hash.addPlain(uint64_t(values.size()));
    for (const T& value : values) add(hash, value);
}

}  // namespace

std::string hashScene(const Scene& scene) {
    Hasher hash;
    addAll(hash, scene.textures);
    addAll(hash, scene.materials);
    addAll(hash, scene.meshes);
    addAll(hash, scene.nodes);
    addAll(hash, scene.skins);
    addAll(hash, scene.instances);
    addAll(hash, scene.lights);
    addAll(hash, scene.cameras);
    add(hash, scene.environment);
    addAll(hash, scene.animation);
    return hash.hex();
}

}  // namespace voxray

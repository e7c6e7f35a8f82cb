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
    hash.addPlain(ref.texture, ref.texCoord, ref.transform);
}

void add(Hasher& hash, const Texture& texture) {
    hash.add(texture.name).addPlain(texture.width, texture.height);
    addArray(hash, texture.rgba);
    hash.addPlain(texture.srgb, texture.wrapU, texture.wrapV, texture.filter);
}

void add(Hasher& hash, const Material& m) {
    hash.add(m.name).addPlain(m.baseColor, m.metallic, m.roughness);
    hash.addPlain(m.specular, m.specularColor, m.ior, m.emission, m.transmission, m.normalScale, m.alphaMode,
                  m.alphaCutoff, m.doubleSided);
    for (const TextureRef* ref :
         {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissiveTexture})
        add(hash, *ref);
}

void add(Hasher& hash, const MorphTargets& morph) {
    hash.addPlain(uint64_t(morph.targets.size()), morph.hasFlatNormals, morph.tangentTexCoords.value_or(~0u));
    for (const MorphTarget& target : morph.targets)
        for (const auto* offsets : {&target.positions, &target.normals, &target.tangents}) addArray(hash, *offsets);
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
    if (!mesh.morph.targets.empty()) add(hash, mesh.morph);
    addArray(hash, mesh.triangles);
}

void add(Hasher& hash, const Node& node) {
    hash.add(node.name).addPlain(node.parent, node.translation);
    hash.addPlain(node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w, node.scale,
                  node.matrix.has_value());
    if (node.matrix) hash.addPlain(*node.matrix);
}

void add(Hasher& hash, const Skin& skin) {
    addArray(hash, skin.joints);
    addArray(hash, skin.inverseBindMatrices);
}

void add(Hasher& hash, const Instance& instance) {
    hash.addPlain(instance.mesh, instance.node, instance.skin);
    if (instance.morph >= 0) hash.addPlain(instance.morph);
}

void add(Hasher& hash, const Light& light) {
    hash.add(light.name).addPlain(light.type, light.intensity);
    hash.addPlain(light.innerConeAngle, light.outerConeAngle, light.position, light.direction, light.node);
}

void add(Hasher& hash, const Camera& camera) {
    hash.add(camera.name).addPlain(camera.verticalFovRadians, camera.position);
    hash.addPlain(camera.forward, camera.up, camera.node);
}

void add(Hasher& hash, const Environment& environment) {
    hash.addPlain(environment.radiance, environment.map != nullptr);
    if (!environment.map) return;
    hash.addPlain(environment.map->width, environment.map->height, environment.map->channels);
    addArray(hash, environment.map->data);
}

void add(Hasher& hash, const AnimationChannel& channel) {
    hash.addPlain(channel.node, channel.property, channel.interpolation);
    addArray(hash, channel.timesSeconds);
    addArray(hash, channel.values);
}

void add(Hasher& hash, const MorphChannel& channel) {
    hash.addPlain(channel.interpolation, channel.targetCount);
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
    if (!scene.morphs.empty()) addAll(hash, scene.morphs);
    return hash.hex();
}

}  // namespace voxray

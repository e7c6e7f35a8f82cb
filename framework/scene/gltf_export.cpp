#include "scene/gltf_export.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "scene/load.h"

namespace voxray {
namespace {

using Object = tinygltf::Value::Object;

tinygltf::Value number(double value) {
    return tinygltf::Value(value);
}

template <typename Vector>
std::vector<double> numbers(const Vector& v) {
    std::vector<double> out;
    for (int i = 0; i < int(Vector::length()); ++i) out.push_back(double(v[i]));
    return out;
}

template <typename Vector>
tinygltf::Value array(const Vector& v) {
    tinygltf::Value::Array out;
    for (int i = 0; i < int(Vector::length()); ++i) out.push_back(number(double(v[i])));
    return tinygltf::Value(std::move(out));
}

int wrapMode(Wrap wrap) {
    return wrap == Wrap::ClampToEdge      ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
           : wrap == Wrap::MirroredRepeat ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                          : TINYGLTF_TEXTURE_WRAP_REPEAT;
}

/// A node whose -Z axis is `forward`.
tinygltf::Node nodeFacing(const std::string& name, const glm::vec3& position, const glm::vec3& forward,
                          const glm::vec3& up) {
    const glm::dvec3 z = -glm::normalize(glm::dvec3(forward));
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(up), z));
    const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
    tinygltf::Node node;
    node.name = name;
    node.translation = numbers(position);
    for (const double component : {q.x, q.y, q.z, q.w}) node.rotation.push_back(std::clamp(component, -1.0, 1.0));
    return node;
}

/// An axis that is far from parallel to the direction.
glm::vec3 anyUp(const glm::vec3& direction) {
    return std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
}

}  // namespace

GltfWriter::GltfWriter() {
    model_.asset.version = "2.0";
    model_.asset.generator = "voxray";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
}

void GltfWriter::extend(tinygltf::ExtensionMap& extensions, const char* name, Object members) {
    extensions[name] = tinygltf::Value(std::move(members));
    auto& used = model_.extensionsUsed;
    if (std::ranges::count(used, name) == 0) used.emplace_back(name);
}

int GltfWriter::addView(const void* data, size_t bytes, int target) {
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = bytes;
    view.target = target;
    const auto* begin = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), begin, begin + bytes);
    model_.bufferViews.push_back(std::move(view));
    return int(model_.bufferViews.size() - 1);
}

template <typename T>
int GltfWriter::addAccessor(const std::vector<T>& values, int type, int componentType, int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(values.data(), values.size() * sizeof(T), target);
    accessor.byteOffset = 0;
    accessor.normalized = false;
    accessor.count = values.size();
    accessor.type = type;
    accessor.componentType = componentType;
    accessor.sparse.isSparse = false;
    model_.accessors.push_back(std::move(accessor));
    return int(model_.accessors.size() - 1);
}

int GltfWriter::addNode(tinygltf::Node node) {
    model_.nodes.push_back(std::move(node));
    const int index = int(model_.nodes.size() - 1);
    model_.scenes[0].nodes.push_back(index);
    return index;
}

void GltfWriter::addTexture(const Texture& texture) {
    const std::vector<uint8_t> png = encodePng({texture.width, texture.height, texture.rgba});
    tinygltf::Image image;
    image.name = texture.name;
    image.mimeType = "image/png";
    image.bufferView = addView(png.data(), png.size(), 0);
    model_.images.push_back(std::move(image));
    tinygltf::Sampler sampler;
    sampler.magFilter = sampler.minFilter =
        texture.filter == TexelFilter::Nearest ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = wrapMode(texture.wrapU);
    sampler.wrapT = wrapMode(texture.wrapV);
    model_.samplers.push_back(std::move(sampler));
    tinygltf::Texture out;
    out.name = texture.name;
    out.source = int(model_.images.size() - 1);
    out.sampler = int(model_.samplers.size() - 1);
    model_.textures.push_back(std::move(out));
}

template <typename Info>
Info GltfWriter::textureInfo(const TextureRef& ref) {
    Info info;
    info.index = ref.texture;
    info.texCoord = int(ref.texCoord);
    const glm::vec3& u = ref.transform[0];
    const glm::vec3& v = ref.transform[1];
    if (ref.texture < 0 || (u == glm::vec3(1, 0, 0) && v == glm::vec3(0, 1, 0))) return info;

    // Decompose the matrix: its columns are the scale times (cos, -sin) and (sin, cos).
    const double scaleU = std::hypot(u.x, v.x);
    const double angle = scaleU > 0 ? std::atan2(-v.x, u.x) : std::atan2(u.y, v.y);
    const double scaleV = std::sin(angle) * u.y + std::cos(angle) * v.y;
    extend(info.extensions, "KHR_texture_transform",
           {{"offset", array(glm::dvec2(u.z, v.z))},
            {"scale", array(glm::dvec2(scaleU, scaleV))},
            {"rotation", number(angle)}});
    return info;
}

void GltfWriter::addMaterials(const Scene& scene) {
    for (const Texture& texture : scene.textures) addTexture(texture);
    for (const Material& m : scene.materials) {
        tinygltf::Material out;
        out.name = m.name;
        out.pbrMetallicRoughness.baseColorFactor = numbers(m.baseColor);
        out.pbrMetallicRoughness.metallicFactor = double(m.metallic);
        out.pbrMetallicRoughness.roughnessFactor = double(m.roughness);
        out.pbrMetallicRoughness.baseColorTexture = textureInfo<tinygltf::TextureInfo>(m.baseColorTexture);
        out.pbrMetallicRoughness.metallicRoughnessTexture =
            textureInfo<tinygltf::TextureInfo>(m.metallicRoughnessTexture);
        out.normalTexture = textureInfo<tinygltf::NormalTextureInfo>(m.normalTexture);
        out.normalTexture.scale = double(m.normalScale);
        out.emissiveTexture = textureInfo<tinygltf::TextureInfo>(m.emissiveTexture);
        out.doubleSided = m.doubleSided;
        if (m.alphaMode == AlphaMode::Mask) out.alphaCutoff = double(m.alphaCutoff);
        out.alphaMode = m.alphaMode == AlphaMode::Mask ? "MASK" : m.alphaMode == AlphaMode::Blend ? "BLEND" : "OPAQUE";

        // emissiveFactor is at most 1; the strength has the rest.
        const double strength = std::max({1.0, double(m.emission.x), double(m.emission.y), double(m.emission.z)});
        out.emissiveFactor = numbers(glm::dvec3(m.emission) / strength);
        if (strength > 1)
            extend(out.extensions, "KHR_materials_emissive_strength", {{"emissiveStrength", number(strength)}});
        if (m.specular != 1 || m.specularColor != glm::vec3(1))
            extend(out.extensions, "KHR_materials_specular",
                   {{"specularFactor", number(m.specular)}, {"specularColorFactor", array(m.specularColor)}});
        if (m.transmission > 0)
            extend(out.extensions, "KHR_materials_transmission", {{"transmissionFactor", number(m.transmission)}});
        if (m.ior != 1.5f) extend(out.extensions, "KHR_materials_ior", {{"ior", number(m.ior)}});
        model_.materials.push_back(std::move(out));
    }
}

void GltfWriter::addInstance(const Geometry& geometry, const InstanceRange& range, const Mesh& mesh) {
    // The instance's range of each array.
    const auto vertices = std::span(geometry.attributes).subspan(range.firstVertex, range.vertexCount);
    const auto positionSpan = std::span(geometry.positions).subspan(range.firstVertex, range.vertexCount);
    const std::vector<glm::vec3> positions(positionSpan.begin(), positionSpan.end());
    std::vector<glm::uvec3> triangles;
    triangles.reserve(range.triangleCount);
    for (uint32_t i = 0; i < range.triangleCount; ++i)
        triangles.push_back(geometry.triangles[range.firstTriangle + i] - range.firstVertex);
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texCoords0;
    std::vector<glm::vec2> texCoords1;
    std::vector<glm::vec4> colors;
    for (const VertexAttributes& a : vertices) {
        normals.push_back(a.normal);
        tangents.push_back(a.tangent);
        texCoords0.emplace_back(a.texCoords.x, a.texCoords.y);
        texCoords1.emplace_back(a.texCoords.z, a.texCoords.w);
        colors.push_back(a.color);
    }

    // glTF requires bounds of positions.
    const int vertexData = TINYGLTF_TARGET_ARRAY_BUFFER;
    const int floats = TINYGLTF_COMPONENT_TYPE_FLOAT;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = int(mesh.material);
    primitive.attributes["POSITION"] = addAccessor(positions, TINYGLTF_TYPE_VEC3, floats, vertexData);
    Box bounds = Box::empty();
    for (const glm::vec3& p : positions) bounds.include(p);
    model_.accessors.back().minValues = numbers(bounds.min);
    model_.accessors.back().maxValues = numbers(bounds.max);
    primitive.attributes["NORMAL"] = addAccessor(normals, TINYGLTF_TYPE_VEC3, floats, vertexData);
    if (!mesh.tangents.empty())
        primitive.attributes["TANGENT"] = addAccessor(tangents, TINYGLTF_TYPE_VEC4, floats, vertexData);
    if (!mesh.texCoords0.empty() || !mesh.texCoords1.empty())
        primitive.attributes["TEXCOORD_0"] = addAccessor(texCoords0, TINYGLTF_TYPE_VEC2, floats, vertexData);
    if (!mesh.texCoords1.empty())
        primitive.attributes["TEXCOORD_1"] = addAccessor(texCoords1, TINYGLTF_TYPE_VEC2, floats, vertexData);
    if (!mesh.colors.empty())
        primitive.attributes["COLOR_0"] = addAccessor(colors, TINYGLTF_TYPE_VEC4, floats, vertexData);
    primitive.indices = addAccessor(triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    model_.accessors.back().count = 3 * triangles.size();

    tinygltf::Mesh out;
    out.name = mesh.name;
    out.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(out));
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = int(model_.meshes.size() - 1);
    addNode(std::move(node));
}

void GltfWriter::addLight(const Light& light) {
    // glTF's colour is at most 1; the intensity has the rest.
    const float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    tinygltf::Light out;
    out.name = light.name;
    out.color = numbers(strength > 0 ? light.intensity / strength : glm::vec3(1));
    out.intensity = double(strength);
    switch (light.type) {
        case LightType::Point:
            out.type = "point";
            break;
        case LightType::Spot:
            out.type = "spot";
            // The outer angle is at most pi/2, which floats round up; the inner one is below it.
            out.spot.outerConeAngle = std::min(double(light.outerConeAngle), M_PI / 2);
            out.spot.innerConeAngle =
                std::min(double(light.innerConeAngle), std::nextafter(out.spot.outerConeAngle, 0.0));
            break;
        case LightType::Directional:
            out.type = "directional";
            break;
    }
    model_.lights.push_back(std::move(out));
    tinygltf::Node node = nodeFacing(light.name, light.position, light.direction, anyUp(light.direction));
    setLight(node, int(model_.lights.size() - 1));
    addNode(std::move(node));
}

void GltfWriter::addCamera(const Camera& camera) {
    tinygltf::Camera out;
    out.name = camera.name;
    out.type = "perspective";
    out.perspective.yfov = double(camera.verticalFovRadians);
    // Planes beyond any scene; tinygltf would write an infinite far plane as an invalid zfar of 0.
    out.perspective.znear = 1e-3;
    out.perspective.zfar = 1e5;
    model_.cameras.push_back(std::move(out));
    tinygltf::Node node = nodeFacing(camera.name, camera.position, camera.forward, camera.up);
    node.camera = int(model_.cameras.size() - 1);
    addNode(std::move(node));
}

std::string GltfWriter::glb() {
    if (model_.buffers[0].data.size() > 0xf0000000u)
        throw Error("the scene has {} MiB of data, a .glb holds less than 4 GiB; export a smaller scene",
                    model_.buffers[0].data.size() >> 20);
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, out, false, true)) throw Error("the scene can't be written as .glb");
    return std::move(out).str();
}

void exportGlb(const SceneState& state, const std::filesystem::path& path) {
    GltfWriter writer;
    writer.addMaterials(*state.scene);
    for (const SceneState* exported : {&state, static_cast<const SceneState*>(state.panes.get())}) {
        if (!exported) continue;
        for (size_t i = 0; i < exported->geometry.instances.size(); ++i)
            writer.addInstance(exported->geometry, exported->geometry.instances[i],
                               exported->scene->meshes[exported->scene->instances[i].mesh]);
    }
    for (const Light& light : state.lights) writer.addLight(light);
    for (const Camera& camera : state.cameras) writer.addCamera(camera);
    writeFileAtomically(path, writer.glb());
}

}  // namespace voxray

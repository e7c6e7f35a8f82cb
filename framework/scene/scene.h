#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "scene/interpolation.h"
#include "scene/morph_types.h"

/// A scene as glTF 2.0 describes it, in metres, right-handed, Y up, linear Rec.709.
/// Plain data, immutable once loaded; `evaluate` (geometry.h) turns it into world-space triangles.
namespace voxray {

enum class Wrap : uint32_t { Repeat, ClampToEdge, MirroredRepeat };
enum class AlphaMode : uint32_t { Opaque, Mask, Blend };
enum class TexelFilter : uint32_t { Linear, Nearest };

/// An image with its sampler. sRGB is decoded before filtering.
struct Texture {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba{};  ///< 4 bytes per texel, row 0 at the top.
    bool srgb = false;            ///< RGB is sRGB-encoded (base colour, emission).
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    TexelFilter filter = TexelFilter::Linear;  ///< Within a level: bilinear or nearest.
};

/// A material's texture and its coordinates: uv' = transform * (u, v, 1).
struct TextureRef {
    int32_t texture = -1;   ///< Index into Scene::textures; -1: none.
    uint32_t texCoord = 0;  ///< 0 or 1.
    std::array<glm::vec3, 2> transform{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
};

/// Metallic-roughness material. Factors multiply their textures.
struct Material {
    std::string name;
    glm::vec4 baseColor{1.0f};
    float metallic = 1.0f;
    float roughness = 1.0f;
    float specular = 1.0f;  ///< KHR_materials_specular; 0 with metallic 0 is exactly Lambert.
    glm::vec3 specularColor{1.0f};
    float ior = 1.5f;          ///< KHR_materials_ior.
    glm::vec3 emission{0.0f};  ///< W/(m² sr): emissiveFactor * KHR_materials_emissive_strength.
    float normalScale = 1.0f;
    float transmission = 0.0f;  ///< KHR_materials_transmission; see panes.h.
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;  ///< Emits on both sides. All materials reflect and occlude on both.
    TextureRef baseColorTexture{};
    TextureRef metallicRoughnessTexture{};  ///< G roughness, B metallic.
    TextureRef normalTexture{};
    TextureRef emissiveTexture{};
};

/// Four joints and weights per vertex.
struct SkinWeights {
    std::vector<glm::uvec4> joints;  ///< Indices into Skin::joints.
    std::vector<glm::vec4> weights;  ///< Nonnegative; those of all sets sum to 1 at a vertex.
};

/// One glTF primitive in object space. Attribute arrays are empty or as long as `positions`.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< Never empty after loading (flat if missing in the file).
    std::vector<glm::vec4> tangents;  ///< xyz and handedness w; computed if a normal map needs them.
    std::vector<glm::vec2> texCoords0;
    std::vector<glm::vec2> texCoords1;
    std::vector<glm::vec4> colors;  ///< Linear RGBA, multiplies the base colour.
    std::vector<SkinWeights> skinWeights;
    MorphTargets morph;  ///< Where weights are animated; other targets are applied when a file is read.
    std::vector<glm::uvec3> triangles;
    uint32_t material = 0;
};

/// A node's local transform: translation * rotation * scale, or a matrix.
struct Node {
    std::string name;
    int32_t parent = -1;
    glm::vec3 translation{0.0f};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1.0f};
    std::optional<glm::mat4> matrix{};
};

/// A skin: joint i transforms vertices by its node's world matrix * inverseBindMatrices[i].
struct Skin {
    std::vector<uint32_t> joints;  ///< Nodes.
    std::vector<glm::mat4> inverseBindMatrices;
};

/// A mesh transformed by a node, or by the joints of a skin, in which case the node is ignored. Morph targets
/// come before both.
struct Instance {
    uint32_t mesh = 0;
    int32_t node = -1;   ///< -1: identity.
    int32_t skin = -1;   ///< Index into Scene::skins; -1: none.
    int32_t morph = -1;  ///< Index into Scene::morphs, which has a weight for each target; -1: none.
};

enum class LightType : uint32_t { Point, Spot, Directional };

/// A punctual light (KHR_lights_punctual, in radiometric units) at its node's origin, along the node's -Z.
/// Without a node, `position` and `direction` are in world space.
struct Light {
    std::string name;
    LightType type = LightType::Point;
    glm::vec3 intensity{1.0f};    ///< Colour * intensity: W/sr (point, spot) or W/m² (directional).
    float innerConeAngle = 0.0f;  ///< Radians from the axis, spot only.
    float outerConeAngle = 0.7853982f;
    glm::vec3 position{0.0f};
    glm::vec3 direction{0, 0, -1};  ///< Direction of propagation, unit length.
    int32_t node = -1;
};

/// A pinhole camera at its node, looking along -Z, +Y up; without a node the vectors are in world space.
struct Camera {
    std::string name;
    float verticalFovRadians = 1.0f;
    glm::vec3 position{0.0f};
    glm::vec3 forward{0, 0, -1};  ///< Unit length.
    glm::vec3 up{0, 1, 0};        ///< Unit length, perpendicular to forward.
    int32_t node = -1;
};

/// Radiance from infinity.
struct Environment {
    glm::vec3 radiance{0.0f};           ///< Multiplies the map; the radiance itself without a map. W/(m² sr).
    std::shared_ptr<const ImageF> map;  ///< Equirectangular, 3 channels, row 0 at +Y; u = 0.5 looks along -Z,
                                        ///< u grows towards +X.
};

enum class AnimatedProperty : uint32_t { Translation, Rotation, Scale };

/// One animated property of one node. For CubicSpline each key has in-tangent, value, out-tangent.
struct AnimationChannel {
    uint32_t node = 0;
    AnimatedProperty property = AnimatedProperty::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> timesSeconds;
    std::vector<glm::vec4> values;
};

struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials;  ///< At least one.
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;  ///< Parents before children.
    std::vector<Skin> skins;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<std::string> orthographicCameras;  ///< Names of ignored ones.
    Environment environment;
    std::vector<AnimationChannel> animation;  ///< All of the file's animations, played together.
    std::vector<MorphChannel> morphs;         ///< Played with them.
    std::vector<std::string> warnings;        ///< Warnings of the loader, one line each.
    std::string contentHash;                  ///< Hash of everything above (hashScene()).
};

}  // namespace voxray

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "scene/builtin.h"
#include "scene/shapes.h"
#include "scene/uniform_random.h"

namespace voxray {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr uint32_t kKeysPerPeriod = 32;

/// A channel that repeats after `period`: value(t) for t from 0 to 1, whose ends are the same.
template <typename Value>
AnimationChannel periodic(uint32_t node, AnimatedProperty property, float period, Value value) {
    AnimationChannel channel;
    channel.node = node;
    channel.property = property;
    for (uint32_t key = 0; key <= kKeysPerPeriod; ++key) {
        channel.timesSeconds.push_back(period * float(key) / float(kKeysPerPeriod));
        channel.values.push_back(value(float(key % kKeysPerPeriod) / float(kKeysPerPeriod)));
    }
    return channel;
}

struct Tree {
    static constexpr const char* name = "tree";
    uint32_t leaves = 900;
    float sway = 0.1f;
    float period = 3.0f;
    uint32_t seed = 1;
    static constexpr auto schema() {
        return std::tuple{
            field("leaves", &Tree::leaves, "Number of leaves.", 1u, 100000u),
            field("sway", &Tree::sway, "How far boughs sway to either side, m; 0: they are still.", 0.0f, 1.0f),
            field("period", &Tree::period, "Duration of a sway there and back, s.", 0.1f, 3600.0f),
            field("seed", &Tree::seed, "Seed of places and directions.")};
    }
};

/// A leaf on a transparent ground: an ellipse with pointed ends, as an alpha mask.
Texture leafTexture() {
    constexpr uint32_t kSize = 32;
    Texture texture;
    texture.name = "leaf";
    texture.width = texture.height = kSize;
    texture.srgb = true;
    texture.rgba.reserve(4 * kSize * kSize);
    for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x) {
            const float along = (float(x) + 0.5f) / float(kSize), across = 2 * (float(y) + 0.5f) / float(kSize) - 1;
            const bool isLeaf = std::abs(across) < 0.8f * std::sin(kPi * along);
            for (const int value : {88, 148, 56, isLeaf ? 255 : 0}) texture.rgba.push_back(uint8_t(value));
        }
    return texture;
}

/// A tree of 4 m on a floor of 12 m, in sun and sky. Its boughs sway, each with a phase of its own.
std::shared_ptr<const Scene> make(const Tree& params) {
    constexpr uint32_t kBoughs = 8;
    constexpr float kCrownRadius = 1.3f, kLeafLength = 0.25f;
    constexpr glm::vec3 kCrown(0, 2.7f, 0);
    SceneBuilder b(Tree::name);
    UniformRandom uniform(params.seed);
    b.quad("floor", {-6, 0, -6}, {0, 0, 12}, {12, 0, 0}, b.lambert("floor", {0.5f, 0.45f, 0.4f}));
    b.box("trunk", {0, 0, 0}, {0.25f, kCrown.y, 0.25f}, 0.3f, b.lambert("bark", {0.3f, 0.2f, 0.12f}));

    b.scene().textures.push_back(leafTexture());
    Material foliage;
    foliage.name = "leaf";
    foliage.metallic = foliage.specular = 0;
    foliage.alphaMode = AlphaMode::Mask;
    foliage.doubleSided = true;
    foliage.baseColorTexture.texture = 0;
    const uint32_t leaf = b.material(foliage);
    std::array<Mesh, kBoughs> boughs;
    for (Mesh& bough : boughs) {
        bough.name = "bough";
        bough.material = leaf;
    }
    for (uint32_t i = 0; i < params.leaves; ++i) {
        glm::vec3 place;
        do {
            place = glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        } while (glm::dot(place, place) > 1);
        const float turn = uniform(0, 2 * kPi), tilt = uniform(-0.8f, 0.8f);
        const glm::vec3 along = kLeafLength * glm::vec3(std::cos(turn), 0, std::sin(turn));
        const glm::vec3 across =
            0.5f * kLeafLength *
            glm::vec3(-std::sin(turn) * std::cos(tilt), std::sin(tilt), std::cos(turn) * std::cos(tilt));
        Mesh& bough = boughs[i % kBoughs];
        appendQuad(bough, kCrownRadius * place - 0.5f * (along + across), along, across);
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
            bough.texCoords0.push_back(corner);
    }
    for (uint32_t i = 0; i < kBoughs; ++i) {
        if (boughs[i].positions.empty()) continue;
        const uint32_t node = uint32_t(b.scene().nodes.size());
        b.scene().nodes.push_back({.name = fmt::format("bough {}", i), .translation = kCrown});
        b.place(b.mesh(std::move(boughs[i])), int32_t(node));
        const glm::vec3 to = params.sway * glm::vec3(uniform(-1, 1), uniform(-0.3f, 0.3f), uniform(-1, 1));
        const float phase = uniform(0, 1);
        if (params.sway > 0)
            b.scene().animation.push_back(periodic(node, AnimatedProperty::Translation, params.period, [&](float time) {
                return glm::vec4(kCrown + to * std::sin(2 * kPi * (time + phase)), 0);
            }));
    }
    b.directionalLight({0.3f, -1, -0.4f}, glm::vec3(8.0f));
    b.scene().environment.radiance = {0.6f, 0.75f, 1.0f};
    b.camera({0.4f, 1.5f, 3.4f}, {0, 2.2f, 0}, 60);
    return b.finish();
}

struct Figure {
    static constexpr const char* name = "figure";
    float bendDegrees = 45.0f;
    float period = 2.0f;
    static constexpr auto schema() {
        return std::tuple{
            field("bend_deg", &Figure::bendDegrees, "How far it bends to either side, degrees.", 0.0f, 80.0f),
            field("period", &Figure::period, "Duration of a bend there and back, s.", 0.1f, 3600.0f)};
    }
};

/// A tube of 1.7 m, closed above, whose vertices follow two joints: the lower half stands, the upper one bends.
Mesh tube(uint32_t material) {
    constexpr uint32_t kSides = 24, kRings = 33;
    constexpr float kHeight = 1.7f, kRadius = 0.2f;
    Mesh mesh;
    mesh.name = "figure";
    mesh.material = material;
    SkinWeights weights;
    const auto add = [&](const glm::vec3& position, const glm::vec3& normal) {
        const float upper = glm::smoothstep(0.35f, 0.65f, position.y / kHeight);
        mesh.positions.push_back(position);
        mesh.normals.push_back(normal);
        weights.joints.push_back({0, 1, 0, 0});
        weights.weights.push_back({1 - upper, upper, 0, 0});
    };
    for (uint32_t ring = 0; ring < kRings; ++ring)
        for (uint32_t side = 0; side < kSides; ++side) {
            const float angle = 2 * kPi * float(side) / float(kSides);
            const glm::vec3 out(std::cos(angle), 0, std::sin(angle));
            add(kRadius * out + glm::vec3(0, kHeight * float(ring) / float(kRings - 1), 0), out);
        }
    for (uint32_t ring = 0; ring + 1 < kRings; ++ring)
        for (uint32_t side = 0; side < kSides; ++side) {
            const uint32_t a = ring * kSides + side, next = ring * kSides + (side + 1) % kSides;
            mesh.triangles.push_back({a, a + kSides, next});
            mesh.triangles.push_back({next, a + kSides, next + kSides});
        }
    const uint32_t top = uint32_t(mesh.positions.size()), rim = (kRings - 1) * kSides;
    for (uint32_t side = 0; side < kSides; ++side) add(mesh.positions[rim + side], {0, 1, 0});
    add({0, kHeight, 0}, {0, 1, 0});
    for (uint32_t side = 0; side < kSides; ++side)
        mesh.triangles.push_back({top + side, top + kSides, top + (side + 1) % kSides});
    mesh.skinWeights.push_back(std::move(weights));
    return mesh;
}

/// A skinned figure that bends, in a room of 4 m x 2.5 m x 4 m with a point light of 6 W/sr.
std::shared_ptr<const Scene> make(const Figure& params) {
    constexpr float kJointHeight = 0.85f;
    SceneBuilder b(Figure::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.75f)), red = b.lambert("red", {0.6f, 0.1f, 0.08f});
    b.room({-2, 0, -2}, {2, 2.5f, 2}, {red, white, white, white, white, white});
    const uint32_t mesh = b.mesh(tube(b.lambert("blue", {0.2f, 0.3f, 0.7f})));

    b.scene().nodes.push_back({.name = "feet"});
    b.scene().nodes.push_back({.name = "chest", .parent = 0, .translation = {0, kJointHeight, 0}});
    const glm::mat4 toJoint = glm::translate(glm::mat4(1), glm::vec3(0, -kJointHeight, 0));
    b.scene().skins.push_back({.joints = {0, 1}, .inverseBindMatrices = {glm::mat4(1), toJoint}});
    b.scene().instances.push_back({.mesh = mesh, .skin = 0});
    b.scene().animation.push_back(periodic(1, AnimatedProperty::Rotation, params.period, [&](float time) {
        const float angle = glm::radians(params.bendDegrees) * std::sin(2 * kPi * time);
        const glm::quat turn = glm::angleAxis(angle, glm::vec3(0, 0, 1));
        return glm::vec4(turn.x, turn.y, turn.z, turn.w);
    }));
    b.pointLight({1.2f, 2.1f, 0.8f}, glm::vec3(6.0f));
    b.camera({1.6f, 1.5f, 1.8f}, {-0.2f, 0.9f, 0}, 60);
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> livingScenes() {
    return {builtinScene<Tree>(), builtinScene<Figure>()};
}

}  // namespace voxray

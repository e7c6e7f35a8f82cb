#include "scene/builtin.h"
#include "scene/shapes.h"
#include "scene/uniform_random.h"

namespace voxray {
namespace {

struct Spheres {
    static constexpr const char* name = "spheres";
    uint32_t count = 16;
    float radius = 0.25f;
    uint32_t seed = 1;
    bool moving = true;
    float period = 8.0f;
    static constexpr auto schema() {
        return std::tuple{
            field("count", &Spheres::count, "Number of spheres.", 1u, 4096u),
            field("radius", &Spheres::radius, "Radius of the spheres, m.", 0.01f, 2.0f),
            field("seed", &Spheres::seed, "Seed of paths and colours."),
            field("moving", &Spheres::moving, "Whether the spheres move; otherwise they stay where they start."),
            field("period", &Spheres::period, "Duration of one round, after which the spheres stop, s.", 0.1f,
                  3600.0f)};
    }
};

constexpr uint32_t colorCount = 8;
constexpr uint32_t keysPerRound = 64;

/// Spheres over a floor of 10 m, each a node on its own ellipse, in the sun.
std::shared_ptr<const Scene> make(const Spheres& params) {
    SceneBuilder b(Spheres::name);
    UniformRandom uniform(params.seed);

    // One mesh per colour, shared by the spheres.
    const uint32_t floor = b.lambert("floor", glm::vec3(0.6f));
    b.quad("floor", {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, floor);
    std::array<uint32_t, colorCount> meshes;
    for (uint32_t& mesh : meshes) {
        const glm::vec3 albedo(uniform(0.1f, 0.8f), uniform(0.1f, 0.8f), uniform(0.1f, 0.8f));
        mesh =
            b.mesh(sphereMesh("sphere", glm::vec3(0.0f), params.radius, 3, b.lambert("sphere", albedo), false, true));
    }

    // Each sphere has its ellipse, height, phase and direction.
    for (uint32_t i = 0; i < params.count; ++i) {
        const glm::vec3 center(uniform(-3, 3), params.radius + uniform(0, 1.5f), uniform(-3, 3));
        const glm::vec2 extent(uniform(0.3f, 1.5f), uniform(0.3f, 1.5f));
        const float start = uniform(0, 6.2831853f);
        const float turn = i % 2 == 0 ? 6.2831853f : -6.2831853f;
        const auto position = [&](float round) {
            const float angle = start + turn * round;
            return center + glm::vec3(extent.x * std::cos(angle), 0, extent.y * std::sin(angle));
        };
        b.scene().nodes.push_back({.name = fmt::format("sphere {}", i), .translation = position(0)});
        b.place(meshes[i % colorCount], int32_t(i));
        if (!params.moving) continue;

        // The last key repeats the first, so that the path closes exactly.
        AnimationChannel channel;
        channel.node = i;
        for (uint32_t key = 0; key <= keysPerRound; ++key) {
            channel.timesSeconds.push_back(params.period * float(key) / float(keysPerRound));
            channel.values.push_back(glm::vec4(position(float(key % keysPerRound) / float(keysPerRound)), 0));
        }
        b.scene().animation.push_back(std::move(channel));
    }
    b.directionalLight({-0.4f, -1, -0.3f}, glm::vec3(3.0f));
    b.camera({0, 4, 8}, {0, 0.5f, 0}, 50);
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> movingScenes() {
    return {builtinScene<Spheres>()};
}

}  // namespace voxray

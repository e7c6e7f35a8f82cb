#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/builtin.h"
#include "scene/shapes.h"
#include "scene/uniform_random.h"

namespace voxray {

enum class LampKind { Mixed, Point, Spot, Surface };
template <>
struct EnumNames<LampKind> {
    static constexpr std::array names{std::pair{LampKind::Mixed, "mixed"}, std::pair{LampKind::Point, "point"},
                                      std::pair{LampKind::Spot, "spot"}, std::pair{LampKind::Surface, "surface"}};
};

namespace {

struct Lamps {
    static constexpr const char* name = "lamps";
    uint32_t count = 10000;
    LampKind kind = LampKind::Mixed;
    float power = 5000.0f;
    uint32_t seed = 1;
    static constexpr auto schema() {
        return std::tuple{
            field("count", &Lamps::count, "Number of lamps.", 1u, 1000000u),
            field("kind", &Lamps::kind,
                  "Point lights, spots of 40 degrees to either side, squares of 5 cm that emit, or these in turn."),
            field("power", &Lamps::power, "Power of all lamps together, W.", 0.0f, 1e9f),
            field("seed", &Lamps::seed, "Seed of their places, directions and colors.")};
    }
};

constexpr glm::vec3 kHallLow(-12, 0, -12), kHallHigh(12, 4, 12);
constexpr float kPillarSpacing = 4.0f, kPillarWidth = 0.6f;

bool isInPillar(const glm::vec3& p) {
    const auto isNear = [](float x) {
        const float nearest = kPillarSpacing * std::round(x / kPillarSpacing);
        return std::abs(x - nearest) < 0.5f * kPillarWidth + 0.1f;
    };
    return isNear(p.x) && isNear(p.z);
}

/// Lamps at random places in a hall of pillars, 24 m x 4 m x 24 m.
std::shared_ptr<const Scene> make(const Lamps& params) {
    SceneBuilder b(Lamps::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.7f)), wood = b.lambert("floor", {0.45f, 0.35f, 0.25f});
    b.room(kHallLow, kHallHigh, {white, white, wood, white, white, white});
    for (int x = -2; x <= 2; ++x)
        for (int z = -2; z <= 2; ++z)
            b.box("pillar", {kPillarSpacing * float(x), 0, kPillarSpacing * float(z)},
                  {kPillarWidth, kHallHigh.y, kPillarWidth}, 0, white);

    constexpr std::array<glm::vec3, 3> colors{glm::vec3(1.2f, 1, 0.7f), glm::vec3(0.8f, 1, 1.2f), glm::vec3(1)};
    constexpr float kEdge = 0.05f, kOuterDegrees = 40;
    const float watts = params.power / float(params.count);
    std::array<Mesh, colors.size()> surfaces;
    for (size_t c = 0; c < colors.size(); ++c) {
        surfaces[c].name = "lamps";
        surfaces[c].material =
            b.lambert("lamp", glm::vec3(0.7f), colors[c] * (watts / (std::numbers::pi_v<float> * kEdge * kEdge)));
    }
    UniformRandom uniform(params.seed);
    for (uint32_t i = 0; i < params.count; ++i) {
        glm::vec3 position;
        do {
            position = {uniform(-11.8f, 11.8f), uniform(0.4f, 3.8f), uniform(-11.8f, 11.8f)};
        } while (isInPillar(position));
        const glm::vec3 direction =
            glm::normalize(glm::vec3(uniform(-1, 1), uniform(-1, 0.2f), uniform(-1, 1)) + glm::vec3(0, -0.01f, 0));
        const size_t color = uniform.below(uint32_t(colors.size()));
        const LampKind kind = params.kind == LampKind::Mixed ? LampKind(1 + i % 3) : params.kind;
        if (kind == LampKind::Point) {
            b.pointLight(position, colors[color] * (watts / (4 * std::numbers::pi_v<float>)));
        } else if (kind == LampKind::Spot) {
            // Full intensity within half of the angle; outside it falls with the square of the cosine
            const float inner = std::cos(0.5f * kOuterDegrees * std::numbers::pi_v<float> / 180),
                        outer = std::cos(kOuterDegrees * std::numbers::pi_v<float> / 180);
            const float solidAngle = 2 * std::numbers::pi_v<float> * (1 - inner + (inner - outer) / 3);
            b.spotLight(position, direction, 0.5f * kOuterDegrees, kOuterDegrees, colors[color] * (watts / solidAngle));
        } else {
            const glm::vec3 side = std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            const glm::vec3 u = kEdge * glm::normalize(glm::cross(side, direction));
            appendQuad(surfaces[color], position, u, glm::cross(direction, u));
        }
    }
    for (Mesh& mesh : surfaces)
        if (!mesh.positions.empty()) b.place(b.mesh(std::move(mesh)));
    b.camera({-11, 2.2f, 10.5f}, {3, 1.2f, -4}, 65);
    return b.finish();
}

struct Candles {
    static constexpr const char* name = "candles";
    uint32_t count = 20;
    float flame = 0.01f;
    static constexpr auto schema() {
        return std::tuple{field("count", &Candles::count, "Number of candles.", 1u, 200u),
                          field("flame", &Candles::flame, "Diameter of a flame, m.", 0.001f, 0.05f)};
    }
};

/// Candles in two rows on a table of 2.4 m in a room of 5 m x 2.6 m x 4 m. Each flame is a ball of 80 triangles of
/// 0.4 W/sr to each side.
std::shared_ptr<const Scene> make(const Candles& params) {
    SceneBuilder b(Candles::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.75f)), red = b.lambert("red", {0.5f, 0.12f, 0.1f});
    const uint32_t wood = b.lambert("wood", {0.5f, 0.33f, 0.2f}), wax = b.lambert("wax", {0.8f, 0.78f, 0.7f});
    b.room({-2.5f, 0, -2}, {2.5f, 2.6f, 2}, {red, white, wood, white, white, white});
    b.box("table", {0, 0.72f, 0}, {2.4f, 0.03f, 1.0f}, 0, wood);
    for (const float x : {-1.1f, 1.1f})
        for (const float z : {-0.42f, 0.42f}) b.box("leg", {x, 0, z}, {0.06f, 0.72f, 0.06f}, 0, wood);
    for (const float x : {-0.75f, 0.0f, 0.75f})
        for (const float z : {-0.9f, 0.9f}) {
            b.box("seat", {x, 0.43f, z}, {0.42f, 0.03f, 0.4f}, 0, wood);
            b.box("back", {x, 0.46f, z + std::copysign(0.2f, z)}, {0.42f, 0.5f, 0.03f}, 0, wood);
        }

    const float radius = 0.5f * params.flame;
    constexpr float kIntensity = 0.4f;  // W/sr
    const glm::vec3 radiance = glm::vec3(1.5f, 1, 0.4f) * (kIntensity / (std::numbers::pi_v<float> * radius * radius));
    const uint32_t flame =
        b.mesh(sphereMesh("flame", glm::vec3(0), radius, 1, b.lambert("flame", glm::vec3(0), radiance), false, false));
    UniformRandom uniform(1);
    const uint32_t columns = (params.count + 1) / 2;
    for (uint32_t i = 0; i < params.count; ++i) {
        const float height = uniform(0.06f, 0.2f);
        const glm::vec3 base(2.2f * ((float(i / 2) + 0.5f) / float(columns) - 0.5f), 0.75f,
                             i % 2 == 0 ? -0.12f : 0.12f);
        b.box("candle", base, {0.02f, height, 0.02f}, 0, wax);
        b.scene().nodes.push_back({.name = "flame", .translation = base + glm::vec3(0, height + 0.01f + radius, 0)});
        b.place(flame, int32_t(b.scene().nodes.size() - 1));
    }
    b.camera({2.2f, 1.7f, 1.8f}, {-0.3f, 0.8f, -0.2f}, 55);
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> lampScenes() {
    return {builtinScene<Lamps>(), builtinScene<Candles>()};
}

}  // namespace voxray

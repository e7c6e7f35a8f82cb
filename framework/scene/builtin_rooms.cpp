#include <glm/trigonometric.hpp>

#include "scene/builtin.h"
#include "scene/shapes.h"

namespace voxray {

enum class CornellLight { Area, Point, Spot, Sun };
template <>
struct EnumNames<CornellLight> {
    static constexpr std::array names{std::pair{CornellLight::Area, "area"}, std::pair{CornellLight::Point, "point"},
                                      std::pair{CornellLight::Spot, "spot"}, std::pair{CornellLight::Sun, "sun"}};
};

enum class ThinWallView { Lit, Dark };
template <>
struct EnumNames<ThinWallView> {
    static constexpr std::array names{std::pair{ThinWallView::Lit, "lit"}, std::pair{ThinWallView::Dark, "dark"}};
};

namespace {

struct Cornell {
    static constexpr const char* name = "cornell";
    CornellLight lights = CornellLight::Area;
    bool boxes = true;
    static constexpr auto schema() {
        return std::tuple{field("lights", &Cornell::lights,
                                "Quad below the ceiling, point or spot light there, or sun through the open front."),
                          field("boxes", &Cornell::boxes, "Whether the two boxes stand in the room.")};
    }
};

/// The Cornell box (Goral et al. 1984; blocks as measured at Cornell), scaled to 2 m, open towards +Z.
std::shared_ptr<const Scene> make(const Cornell& params) {
    SceneBuilder b(Cornell::name);
    const uint32_t grey = b.lambert("grey", glm::vec3(0.73f));
    const uint32_t red = b.lambert("red", {0.63f, 0.065f, 0.05f});
    const uint32_t green = b.lambert("green", {0.14f, 0.45f, 0.091f});
    b.room({-1, 0, -1}, {1, 2, 1}, {red, green, grey, grey, grey, SceneBuilder::none});
    if (params.boxes) {
        b.box("tall box", {-0.326f, 0, -0.257f}, {0.594f, 1.189f, 0.594f}, glm::radians(17.2f), grey);
        b.box("short box", {0.333f, 0, 0.398f}, {0.594f, 0.594f, 0.594f}, glm::radians(-16.6f), grey);
    }
    switch (params.lights) {
        case CornellLight::Area: {
            const uint32_t lamp = b.lambert("lamp", glm::vec3(0.73f), glm::vec3(20.0f));
            b.quad("lamp", {-0.235f, 1.99f, -0.19f}, {0.47f, 0, 0}, {0, 0, 0.38f}, lamp);
            break;
        }
        case CornellLight::Point:
            b.pointLight({0, 1.8f, 0}, glm::vec3(2.0f));
            break;
        case CornellLight::Spot:
            b.spotLight({0, 1.8f, 0}, {0, -1, 0}, 30, 45, glm::vec3(6.0f));
            break;
        case CornellLight::Sun:
            b.directionalLight({0.25f, -0.6f, -1}, glm::vec3(4.0f));
            break;
    }
    b.camera({0, 1, 3.8f}, {0, 1, 0}, 40);
    return b.finish();
}

struct StillLife {
    static constexpr const char* name = "still_life";
    float glow = 9.0f;
    static constexpr auto schema() {
        return std::tuple{field("glow", &StillLife::glow,
                                "Red radiance of the glowing ball, W/(m² sr); green and blue are proportional.", 0.0f,
                                1e6f)};
    }
};

/// Boxes and balls in a room of 3.4 m x 2 m x 2.4 m between two colored walls, open towards +Z; one ball
/// glows.
std::shared_ptr<const Scene> make(const StillLife& params) {
    SceneBuilder b(StillLife::name);
    const uint32_t grey = b.lambert("grey", glm::vec3(0.73f));
    const uint32_t orange = b.lambert("orange", {0.72f, 0.22f, 0.06f});
    const uint32_t teal = b.lambert("teal", {0.05f, 0.32f, 0.42f});
    b.room({-1.7f, 0, -1.2f}, {1.7f, 2, 1.2f}, {orange, teal, grey, grey, grey, SceneBuilder::none});
    b.box("tall box", {-0.85f, 0, -0.45f}, {0.5f, 1.15f, 0.5f}, glm::radians(20.0f), grey);
    b.box("short box", {0.85f, 0, 0.1f}, {0.55f, 0.45f, 0.55f}, glm::radians(-18.0f), grey);
    const auto ball = [&](const char* name, const glm::vec3& center, float radius, uint32_t material) {
        b.place(b.mesh(sphereMesh(name, center, radius, 3, material, false, true)));
    };
    ball("white ball", {-0.2f, 0.28f, 0.35f}, 0.28f, b.lambert("white", glm::vec3(0.8f)));
    ball("violet ball", {0.85f, 0.66f, 0.1f}, 0.21f, b.lambert("violet", {0.3f, 0.12f, 0.5f}));
    const glm::vec3 emission = params.glow * glm::vec3(1.0f, 0.5f, 0.13f);
    ball("glowing ball", {0.25f, 0.17f, -0.35f}, 0.17f, b.lambert("glowing", glm::vec3(0.5f), emission));
    b.pointLight({0.5f, 1.7f, 0.5f}, glm::vec3(3.0f));
    b.camera({0, 1, 3.6f}, {0, 0.95f, 0}, 42);
    return b.finish();
}

struct ThinWall {
    static constexpr const char* name = "thin_wall";
    float thickness = 0.05f;
    ThinWallView view = ThinWallView::Dark;
    static constexpr auto schema() {
        return std::tuple{
            field("thickness", &ThinWall::thickness, "Thickness of the wall between the rooms, m.", 0.001f, 1.0f),
            field("view", &ThinWall::view, "The room that the camera stands in.")};
    }
};

/// Two sealed rooms of 2 m side by side, a light in the one at -X. The other is exactly black.
std::shared_ptr<const Scene> make(const ThinWall& params) {
    SceneBuilder b(ThinWall::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.8f));
    const float half = 0.5f * params.thickness;
    b.room({-half - 2, 0, -1}, {-half, 2, 1}, {white, white, white, white, white, white});
    b.room({half, 0, -1}, {half + 2, 2, 1}, {white, white, white, white, white, white});
    b.pointLight({-half - 1, 1.5f, 0}, glm::vec3(1.0f));
    const float side = params.view == ThinWallView::Dark ? 1.0f : -1.0f;
    b.camera({side * (half + 1.9f), 1, 0}, {0, 1, 0}, 70);
    return b.finish();
}

uint32_t perfectMirror(SceneBuilder& b) {
    return b.material({.name = "mirror", .roughness = 0});
}

struct MirrorRoom {
    static constexpr const char* name = "mirror_room";
    uint32_t count = 5;
    static constexpr auto schema() {
        return std::tuple{
            field("count", &MirrorRoom::count, "Number of spheres in the row before the mirror.", 1u, 16u)};
    }
};

/// A room of 4 m x 2.5 m x 4 m whose wall at -Z is a perfect mirror, a row of coloured spheres before it.
std::shared_ptr<const Scene> make(const MirrorRoom& params) {
    SceneBuilder b(MirrorRoom::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.7f));
    const uint32_t blue = b.lambert("blue", {0.1f, 0.2f, 0.6f});
    const uint32_t orange = b.lambert("orange", {0.7f, 0.35f, 0.08f});
    const uint32_t mirror = perfectMirror(b);
    b.room({-2, 0, -2}, {2, 2.5f, 2}, {blue, orange, white, white, mirror, white});

    // The spheres share the width of the room.
    const float step = 3.6f / float(params.count);
    const float radius = std::min(0.3f, 0.4f * step);
    for (uint32_t i = 0; i < params.count; ++i) {
        const float x = -1.8f + (float(i) + 0.5f) * step;
        const float hue = float(i) / float(params.count);
        const glm::vec3 albedo = 0.4f + 0.35f * glm::cos(6.2831853f * (hue + glm::vec3(0, 0.667f, 0.333f)));
        const uint32_t color = b.lambert("sphere", albedo);
        b.place(b.mesh(sphereMesh("sphere", {x, radius, -0.8f}, radius, 4, color, false, true)));
    }
    const uint32_t lamp = b.lambert("lamp", glm::vec3(0.7f), glm::vec3(10.0f));
    b.quad("lamp", {-0.5f, 2.49f, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp);
    b.camera({0, 1.2f, 1.9f}, {0, 0.8f, -2}, 60);
    return b.finish();
}

struct MirrorRow {
    static constexpr const char* name = "mirror_row";
    uint32_t count = 8;
    static constexpr auto schema() {
        return std::tuple{
            field("count", &MirrorRow::count, "Number of spheres over the mirror, one every 2 m.", 1u, 64u)};
    }
};

/// A row of equal spheres 1 m over a mirror in the plane y = 0, in the sun: number i, from 1 on, over
/// (0, 0, -2 i). All of their reflections look alike, but for where they are seen from.
std::shared_ptr<const Scene> make(const MirrorRow& params) {
    SceneBuilder b(MirrorRow::name);
    const uint32_t orange = b.lambert("sphere", {0.7f, 0.35f, 0.08f});
    const float length = 2.0f * float(params.count) + 2.0f;
    b.quad("mirror", {-2, 0, 0}, {5, 0, 0}, {0, 0, -length}, perfectMirror(b));
    for (uint32_t i = 1; i <= params.count; ++i)
        b.place(b.mesh(sphereMesh("sphere", {0, 1, -2.0f * float(i)}, 0.4f, 4, orange, false, true)));
    b.directionalLight({-0.7f, -0.2f, -0.5f}, glm::vec3(4.0f));
    b.camera({2.5f, 1.2f, 0}, {0, -1, -4}, 60);
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> roomScenes() {
    return {builtinScene<Cornell>(), builtinScene<StillLife>(), builtinScene<ThinWall>(), builtinScene<MirrorRoom>(),
            builtinScene<MirrorRow>()};
}

}  // namespace voxray

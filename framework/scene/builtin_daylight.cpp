#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "scene/builtin.h"
#include "scene/shapes.h"

namespace voxray {

enum class ShellLight { Outside, Inside };
template <>
struct EnumNames<ShellLight> {
    static constexpr std::array names{std::pair{ShellLight::Outside, "outside"},
                                      std::pair{ShellLight::Inside, "inside"}};
};

namespace {

using Corners = SceneBuilder::Corners;

/// A rectangle in the plane y = `y`, counter-clockwise seen from below.
Corners horizontal(float y, const glm::vec2& minXz, const glm::vec2& maxXz) {
    return {{{minXz.x, y, minXz.y}, {maxXz.x, y, minXz.y}, {maxXz.x, y, maxXz.y}, {minXz.x, y, maxXz.y}}};
}

/// A rectangle in the plane z = `z`, counter-clockwise seen from +Z.
Corners vertical(float z, const glm::vec2& minXy, const glm::vec2& maxXy) {
    return {{{minXy.x, minXy.y, z}, {maxXy.x, minXy.y, z}, {maxXy.x, maxXy.y, z}, {minXy.x, maxXy.y, z}}};
}

struct WindowRoom {
    static constexpr const char* name = "window_room";
    float wallThickness = 0.2f;
    float sill = 0.1f;
    uint32_t slats = 0;
    float slatWidth = 0.05f;
    float slatTiltDegrees = 30;
    float groundDistance = 0.2f;
    float sunElevationDegrees = 40;
    float sunAzimuthDegrees = 25;
    static constexpr auto schema() {
        return std::tuple{
            field("wall_thickness", &WindowRoom::wallThickness, "Thickness of walls and roof, m.", 0.01f, 1.0f),
            field("sill", &WindowRoom::sill,
                  "How far the sill's board juts out of the wall on either side, m; 0: no sill.", 0.0f, 0.5f),
            field("slats", &WindowRoom::slats, "Number of slats of the blind in the window; 0: no blind.", 0u, 200u),
            field("slat_width", &WindowRoom::slatWidth, "Width of a slat, m.", 0.005f, 0.2f),
            field("slat_tilt_deg", &WindowRoom::slatTiltDegrees,
                  "Tilt of the slats, outer edges down, degrees: 0 horizontal, 90 closed.", -90.0f, 90.0f),
            field("ground_distance", &WindowRoom::groundDistance, "Depth of the ground outside below the floor, m.",
                  0.0f, 20.0f),
            field("sun_elevation_deg", &WindowRoom::sunElevationDegrees,
                  "Elevation of the sun above the horizon, degrees.", 1.0f, 89.0f),
            field("sun_azimuth_deg", &WindowRoom::sunAzimuthDegrees,
                  "Azimuth of the sun off the window's axis, towards -X, degrees.", -80.0f, 80.0f)};
    }
};

/// A room of 5 m x 2.7 m x 4 m with a window of 2 m x 1.3 m in the wall at +Z, on a ground of 46 m, lit by
/// sun and sky. Walls, roof and ground are one closed solid, so that nothing lights them from within.
std::shared_ptr<const Scene> make(const WindowRoom& params) {
    SceneBuilder b(WindowRoom::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.75f));
    const uint32_t wood = b.lambert("wood", {0.5f, 0.33f, 0.2f});
    const uint32_t facade = b.lambert("facade", {0.7f, 0.6f, 0.5f});
    const uint32_t ground = b.lambert("ground", {0.3f, 0.32f, 0.25f});
    const uint32_t blue = b.lambert("blue", {0.15f, 0.25f, 0.5f});

    const glm::vec3 min(-2.5f, 0, -2), max(2.5f, 2.7f, 2);
    const float t = params.wallThickness;
    const glm::vec3 outerMin(min.x - t, -params.groundDistance, min.z - t), outerMax = max + t;
    const glm::vec2 windowMin(-1, 0.9f), windowMax(1, 2.2f);

    // Inside: the wall with the window, the others, and the window's reveal through the wall.
    b.room(min, max, {white, white, wood, white, white, SceneBuilder::none});
    const Corners innerWindow = vertical(max.z, windowMin, windowMax);
    const Corners outerWindow = vertical(outerMax.z, windowMin, windowMax);
    b.band("wall +z", innerWindow, vertical(max.z, glm::vec2(min), glm::vec2(max)), white);
    b.band("reveal", outerWindow, innerWindow, white);
    b.box("cabinet", {1.6f, 0, -1.5f}, {1.2f, 1.0f, 0.5f}, glm::radians(-20.0f), blue);

    // Outside: the same walls, the roof, and a slab of ground round them.
    const glm::vec3 x(outerMax.x - outerMin.x, 0, 0), y(0, outerMax.y - outerMin.y, 0),
        z(0, 0, outerMax.z - outerMin.z);
    b.quad("facade -x", outerMin, z, y, facade);
    b.quad("facade +x", outerMax, -y, -z, facade);
    b.quad("facade -z", outerMin, y, x, facade);
    b.band("facade +z", vertical(outerMax.z, glm::vec2(outerMin), glm::vec2(outerMax)), outerWindow, facade);
    b.quad("roof", outerMax, -z, -x, facade);
    const glm::vec2 footMin(outerMin.x, outerMin.z), footMax(outerMax.x, outerMax.z);
    const glm::vec2 half(23);
    b.band("ground", horizontal(outerMin.y, footMin, footMax), horizontal(outerMin.y, -half, half), ground);
    b.band("ground's edge", horizontal(outerMin.y, -half, half), horizontal(outerMin.y - 0.5f, -half, half), ground);
    b.quad("ground's bottom", {-half.x, outerMin.y - 0.5f, -half.y}, {2 * half.x, 0, 0}, {0, 0, 2 * half.y}, ground);

    // The sill's board covers the reveal's lower side, which lies 1 cm below the board's top.
    if (params.sill > 0)
        b.box("sill", {0, windowMin.y - 0.02f, max.z + 0.5f * t},
              {windowMax.x - windowMin.x + 0.1f, 0.03f, t + 2 * params.sill}, 0, white);

    // The blind hangs in the center of the wall.
    const float tilt = glm::radians(params.slatTiltDegrees);
    const glm::vec3 across = params.slatWidth * glm::vec3(0, -std::sin(tilt), std::cos(tilt));
    for (uint32_t i = 0; i < params.slats; ++i) {
        const float height = glm::mix(windowMin.y, windowMax.y, (float(i) + 0.5f) / float(params.slats));
        const glm::vec3 center(windowMin.x + 0.01f, height, max.z + 0.5f * t);
        b.quad("slat", center - 0.5f * across, across, {windowMax.x - windowMin.x - 0.02f, 0, 0}, white);
    }

    const float elevation = glm::radians(params.sunElevationDegrees);
    const float azimuth = glm::radians(params.sunAzimuthDegrees);
    b.directionalLight(
        {std::cos(elevation) * std::sin(azimuth), -std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)},
        glm::vec3(20.0f));
    b.scene().environment.radiance = {1.0f, 1.25f, 1.6f};
    b.camera({-2.2f, 1.6f, -1.7f}, {0.6f, 1.0f, 2}, 70);
    return b.finish();
}

struct ShellRoom {
    static constexpr const char* name = "shell_room";
    float wallThickness = 0.1f;
    float overhang = 2.0f;
    ShellLight light = ShellLight::Outside;
    static constexpr auto schema() {
        return std::tuple{
            field("wall_thickness", &ShellRoom::wallThickness, "Thickness of walls, floor slab and roof, m.", 0.001f,
                  1.0f),
            field("overhang", &ShellRoom::overhang, "How far floor slab and ceiling extend beyond the walls, m.", 0.1f,
                  20.0f),
            field("light", &ShellRoom::light, "The sun outside (20 W/m²), or a point light inside (2 W/sr).")};
    }
};

/// A sealed room of 4 m x 2.5 m x 4 m. Its floor and its ceiling run on outside at the same heights. In the
/// sun inside is exactly black, with the light inside outside is.
std::shared_ptr<const Scene> make(const ShellRoom& params) {
    SceneBuilder b(ShellRoom::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.75f));
    const float t = params.wallThickness, height = 2.5f;
    b.room({-2, 0, -2}, {2, height, 2}, {white, white, white, white, white, white});

    const glm::vec2 foot(2 + t), slab = foot + params.overhang;
    b.band("outer walls", horizontal(height, -foot, foot), horizontal(0, -foot, foot), white);
    b.band("floor outside", horizontal(0, -foot, foot), horizontal(0, -slab, slab), white);
    b.band("ceiling outside", horizontal(height, -slab, slab), horizontal(height, -foot, foot), white);
    b.band("floor's edge", horizontal(0, -slab, slab), horizontal(-t, -slab, slab), white);
    b.band("roof's edge", horizontal(height + t, -slab, slab), horizontal(height, -slab, slab), white);
    const glm::vec3 x(2 * slab.x, 0, 0), z(0, 0, 2 * slab.y);
    b.quad("floor's bottom", {-slab.x, -t, -slab.y}, x, z, white);
    b.quad("roof", {-slab.x, height + t, -slab.y}, z, x, white);

    // The sun stands low: it shines on the floor below the roof, up to the walls.
    if (params.light == ShellLight::Outside)
        b.directionalLight({0.5f, -0.6f, -1}, glm::vec3(20.0f));
    else
        b.pointLight({0.5f, 1.5f, 0.5f}, glm::vec3(2.0f));
    b.camera({-1.8f, 1.5f, -1.8f}, {0.5f, 1.0f, 1}, 75);
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> daylightScenes() {
    return {builtinScene<WindowRoom>(), builtinScene<ShellRoom>()};
}

}  // namespace voxray

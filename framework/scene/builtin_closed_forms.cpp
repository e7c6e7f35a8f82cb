#include "scene/builtin.h"
#include "scene/shapes.h"

namespace voxray {

enum class FurnaceShape { Sphere, Box };
template <>
struct EnumNames<FurnaceShape> {
    static constexpr std::array names{std::pair{FurnaceShape::Sphere, "sphere"}, std::pair{FurnaceShape::Box, "box"}};
};

enum class PlaneLight { Point, Spot, Directional };
template <>
struct EnumNames<PlaneLight> {
    static constexpr std::array names{std::pair{PlaneLight::Point, "point"}, std::pair{PlaneLight::Spot, "spot"},
                                      std::pair{PlaneLight::Directional, "directional"}};
};

namespace {

struct Furnace {
    static constexpr const char* name = "furnace";
    float albedo = 0.5f;
    float emission = 1.0f;
    FurnaceShape shape = FurnaceShape::Sphere;
    static constexpr auto schema() {
        return std::tuple{field("albedo", &Furnace::albedo, "Albedo of all surfaces.", 0.0f, 1.0f),
                          field("emission", &Furnace::emission, "Radiance of all surfaces, W/(m² sr).", 0.0f, 1e6f),
                          field("shape", &Furnace::shape, "Sphere of 1 m radius or box of 2 m side.")};
    }
};

/// A closed Lambert surface round the camera. After N bounces every pixel is emission * sum of albedo^k,
/// k = 0 ... N + 1. Normals are flat, so that this holds for the faceted sphere too.
std::shared_ptr<const Scene> make(const Furnace& params) {
    SceneBuilder b(Furnace::name);
    const uint32_t wall = b.lambert("wall", glm::vec3(params.albedo), glm::vec3(params.emission));
    if (params.shape == FurnaceShape::Sphere)
        b.place(b.mesh(sphereMesh("furnace", glm::vec3(0.0f), 1, 4, wall, true, false)));
    else
        b.room(glm::vec3(-1), glm::vec3(1), {wall, wall, wall, wall, wall, wall});
    b.camera({0, 0, 0}, {0, 0, -1}, 60);
    return b.finish();
}

struct WhiteRoom {
    static constexpr const char* name = "white_room";
    float albedo = 0.8f;
    float intensity = 1.0f;
    static constexpr auto schema() {
        return std::tuple{field("albedo", &WhiteRoom::albedo, "Albedo of all walls.", 0.0f, 1.0f),
                          field("intensity", &WhiteRoom::intensity, "Intensity of the point light, W/sr.", 0.0f, 1e6f)};
    }
};

/// A closed cube of 2 m with a point light in its center: the walls receive all 4 pi I watts, so that their
/// mean radiosity is 4 pi I albedo / (24 m² (1 - albedo)).
std::shared_ptr<const Scene> make(const WhiteRoom& params) {
    SceneBuilder b(WhiteRoom::name);
    const uint32_t wall = b.lambert("wall", glm::vec3(params.albedo));
    b.room(glm::vec3(-1), glm::vec3(1), {wall, wall, wall, wall, wall, wall});
    b.pointLight({0, 0, 0}, glm::vec3(params.intensity));
    b.camera({0, 0, 0.95f}, {0, 0, -1}, 80);
    return b.finish();
}

struct QuadLight {
    static constexpr const char* name = "quad_light";
    float lightSize = 1.0f;
    float receiverSize = 1.0f;
    float distance = 1.0f;
    float radiance = 1.0f;
    float albedo = 0.5f;
    static constexpr auto schema() {
        return std::tuple{
            field("light_size", &QuadLight::lightSize, "Side of the square light, m.", 0.01f, 100.0f),
            field("receiver_size", &QuadLight::receiverSize, "Side of the square receiver, m.", 0.01f, 100.0f),
            field("distance", &QuadLight::distance, "Distance between light and receiver, m.", 0.01f, 100.0f),
            field("radiance", &QuadLight::radiance, "Radiance of the light, W/(m² sr).", 0.0f, 1e6f),
            field("albedo", &QuadLight::albedo, "Albedo of the receiver.", 0.0f, 1.0f)};
    }
};

/// A black square that emits downwards over a parallel Lambert square in the plane y = 0, centered on one
/// axis. The camera sees the receiver's center from below the light.
std::shared_ptr<const Scene> make(const QuadLight& params) {
    SceneBuilder b(QuadLight::name);
    const uint32_t receiver = b.lambert("receiver", glm::vec3(params.albedo));
    const uint32_t lamp = b.lambert("lamp", glm::vec3(0.0f), glm::vec3(params.radiance));
    const float r = params.receiverSize;
    const float l = params.lightSize;
    b.quad("receiver", {-0.5f * r, 0, -0.5f * r}, {0, 0, r}, {r, 0, 0}, receiver);
    b.quad("lamp", {-0.5f * l, params.distance, -0.5f * l}, {l, 0, 0}, {0, 0, l}, lamp);
    b.camera({0, 0.9f * params.distance, 1.2f * r}, {0, 0, 0}, 45);
    return b.finish();
}

struct Plane {
    static constexpr const char* name = "plane";
    PlaneLight light = PlaneLight::Point;
    float albedo = 0.5f;
    float height = 1.0f;
    float intensity = 1.0f;
    static constexpr auto schema() {
        return std::tuple{
            field("light", &Plane::light, "The light over the plane."),
            field("albedo", &Plane::albedo, "Albedo of the plane.", 0.0f, 1.0f),
            field("height", &Plane::height, "Height of a point or spot light over the plane, m.", 0.01f, 100.0f),
            field("intensity", &Plane::intensity, "Intensity of the light, W/sr; of the directional one, W/m².", 0.0f,
                  1e6f)};
    }
};

/// A Lambert square of 10 m in the plane y = 0, seen from straight above; up in the image is -Z. Point and
/// spot light are above the origin; the spot points down with its cone from 20° to 40°; the directional light
/// has the direction (1, -2, 0).
std::shared_ptr<const Scene> make(const Plane& params) {
    SceneBuilder b(Plane::name);
    const uint32_t ground = b.lambert("ground", glm::vec3(params.albedo));
    b.quad("ground", {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, ground);
    const glm::vec3 strength(params.intensity);
    switch (params.light) {
        case PlaneLight::Point:
            b.pointLight({0, params.height, 0}, strength);
            break;
        case PlaneLight::Spot:
            b.spotLight({0, params.height, 0}, {0, -1, 0}, 20, 40, strength);
            break;
        case PlaneLight::Directional:
            b.directionalLight({1, -2, 0}, strength);
            break;
    }
    b.camera({0, 4, 0}, {0, 0, 0}, 50, {0, 0, -1});
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> closedFormScenes() {
    return {builtinScene<Furnace>(), builtinScene<WhiteRoom>(), builtinScene<QuadLight>(), builtinScene<Plane>()};
}

}  // namespace voxray

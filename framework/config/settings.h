#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/value.h"
#include "config/scene_additions.h"
#include "image/tone.h"
#include "scene/moving_spheres.h"
#include "scene/scene.h"
#include "trace/ray_tracer.h"

/// Settings of the blocks of a config, with names, ranges, defaults and help of all scalar keys.
namespace voxray {

template <>
struct EnumNames<TracerKind> {
    static constexpr std::array names{std::pair{TracerKind::Auto, "auto"}, std::pair{TracerKind::RayQuery, "ray_query"},
                                      std::pair{TracerKind::RayPipeline, "ray_pipeline"},
                                      std::pair{TracerKind::Embree, "embree"}};
};

template <>
struct EnumNames<ToneCurve> {
    static constexpr std::array names{std::pair{ToneCurve::Srgb, "srgb"},
                                      std::pair{ToneCurve::PbrNeutral, "pbr_neutral"}};
};

enum class MaterialMode { AsIs, Lambert };
template <>
struct EnumNames<MaterialMode> {
    static constexpr std::array names{std::pair{MaterialMode::AsIs, "as_is"},
                                      std::pair{MaterialMode::Lambert, "lambert"}};
};

/// Maximum coordinate (m), intensity (W/sr, W/m²) and radiance (W/(m² sr)) in a config.
inline constexpr float kMaxCoordinate = 1e6f;
inline constexpr float kMaxLight = 1e12f;

/// A position or direction.
template <typename Settings>
constexpr auto vectorField(const char* name, glm::vec3 Settings::*member, const char* help) {
    return field(name, member, help, glm::vec3(-kMaxCoordinate), glm::vec3(kMaxCoordinate)).asVector();
}

/// Top-level scalars.
struct GeneralSettings {
    std::string name;
    uint64_t seed = 0;
    TracerKind tracer = TracerKind::Auto;
    static constexpr auto schema() {
        return std::tuple{
            field("name", &GeneralSettings::name,
                  "Name of the experiment and of its results folder: letters, digits, '_', '-', '.'."),
            field("seed", &GeneralSettings::seed, "Seed of all random numbers.", uint64_t(0), uint64_t(INT64_MAX)),
            field("tracer", &GeneralSettings::tracer,
                  "Ray-tracing backend; auto takes the GPU's where it has one, else Embree.")};
    }
};

/// `image`.
struct ImageSettings {
    uint32_t width = 640;
    uint32_t height = 360;
    float exposureStops = 0;
    ToneCurve tone = ToneCurve::Srgb;
    static constexpr auto schema() {
        return std::tuple{
            field("width", &ImageSettings::width, "Width in pixels.", 1u, 8192u),
            field("height", &ImageSettings::height, "Height in pixels.", 1u, 8192u),
            field("exposure_stops", &ImageSettings::exposureStops,
                  "Exposure of previews and LDR metrics: radiance is scaled by 2^stops.", -30.0f, 30.0f),
            field("tone", &ImageSettings::tone,
                  "Tone curve of previews: srgb clips to white, pbr_neutral (Khronos) compresses highlights. "
                  "Metrics don't depend on it.")};
    }
};

/// An entry of `measure.masks`: pixels are selected if their surface meets all its conditions.
struct MaskSettings {
    std::string name;  ///< Its key.
    std::string material;
    std::string object;
    float minMetallic = 0;
    float maxRoughness = 1;
    TextLocation where;
    static constexpr auto schema() {
        return std::tuple{
            field("material", &MaskSettings::material, "Name of the surface's material; empty: any."),
            field("object", &MaskSettings::object, "Name of its mesh or of the node that places it; empty: any."),
            field("min_metallic", &MaskSettings::minMetallic, "Smallest metallic value at the point, texture included.",
                  0.0f, 1.0f),
            field("max_roughness", &MaskSettings::maxRoughness, "Largest roughness at the point, texture included.",
                  0.0f, 1.0f)};
    }
};

/// `measure`; the schema has its scalar keys.
struct MeasureSettings {
    uint32_t frames = 20;
    uint32_t warmup = 3;
    uint32_t compareEvery = 0;
    uint32_t buildRepeats = 1;
    bool secondSeed = false;
    uint64_t memoryLimitMb = 0;
    std::vector<std::string> metrics;  ///< A subset of metricNames().
    std::vector<MaskSettings> masks;
    static constexpr auto schema() {
        return std::tuple{field("frames", &MeasureSettings::frames,
                                "Number of timed frames. The first one is compared with the reference.", 1u, 100000u),
                          field("warmup", &MeasureSettings::warmup,
                                "Number of frames before the measured ones, which are not timed.", 0u, 100000u),
                          field("compare_every", &MeasureSettings::compareEvery,
                                "0: frame 0 alone is compared with a reference. n: every n-th measured frame is, "
                                "each with the reference of its own time, and temporal error is reported.",
                                0u, 100000u),
                          field("build_repeats", &MeasureSettings::buildRepeats,
                                "Timed runs of the build passes, after one that is not timed. "
                                "0: that first one is timed, with all that only a first run takes.",
                                0u, 1000u),
                          field("second_seed", &MeasureSettings::secondSeed,
                                "Render each variant once more with other random numbers, not timed: "
                                "splits its error into bias and noise."),
                          field("memory_limit_mb", &MeasureSettings::memoryLimitMb,
                                "Device memory in MiB that a graph may take; 0: what the device has.", uint64_t(0),
                                uint64_t(1) << 24)};
    }
};

/// The path of a key of `scene`, `image` or `measure`, e.g. "scene.camera" for `camera`; "" for other words.
std::string pathOfKey(const std::string& key);

/// Number of measured frames compared with a reference: 0, compareEvery, 2 compareEvery ...
uint32_t comparedFrames(const MeasureSettings& settings);

/// Valid names in `measure.metrics`.
std::vector<std::string> metricNames();

/// Scalar keys of `scene`, except its source.
struct SceneOptions {
    bool keepFileLights = true;
    MaterialMode materials = MaterialMode::AsIs;
    uint32_t subdivide = 0;
    double time = 0;
    double timeStep = 0;
    static constexpr auto schema() {
        return std::tuple{
            field("keep_file_lights", &SceneOptions::keepFileLights,
                  "Keep the scene's own punctual lights; false leaves those of `lights` alone. "
                  "Emissive surfaces always stay."),
            field("materials", &SceneOptions::materials,
                  "as_is, or lambert: "
                  "drop specular, metal and transmission of what scenes bring, keep base colour and emission."),
            field("subdivide", &SceneOptions::subdivide,
                  "Splits every triangle in four in place, so often: the same surfaces of more triangles.", 0u, 4u),
            field("time", &SceneOptions::time, "Time of the compared frame in the animation, seconds.", 0.0, 1e6),
            field("time_step", &SceneOptions::timeStep,
                  "Seconds of animation from one frame to the next; 0: everything stands still. "
                  "Warm-up frames lead up to `time`; the animation repeats after its last key.",
                  0.0, 1e6)};
    }
};

/// An entry of `path` of `scene.camera`.
struct CameraKey {
    uint32_t frame = 1;
    glm::vec3 position{0.0f};
    glm::vec3 target{0.0f};
    static constexpr auto schema() {
        return std::tuple{
            field("frame", &CameraKey::frame,
                  "The measured frame in which the camera is there; in the first one, 0, it is at its own `position`.",
                  1u, 100000u),
            vectorField("position", &CameraKey::position, "Position of the camera in that frame, metres."),
            vectorField("target", &CameraKey::target, "The point that it looks at then, metres.")};
    }
};

/// `scene.camera` as a map; the schema has its keys but `path`.
struct CameraSettings {
    glm::vec3 position{0.0f};
    glm::vec3 target{0.0f};
    glm::vec3 up{0, 1, 0};
    float fovDegrees = 60;
    glm::vec3 move{0.0f};
    std::vector<CameraKey> path;  ///< By frame.
    static constexpr auto schema() {
        return std::tuple{
            vectorField("position", &CameraSettings::position, "Position of the camera, metres."),
            vectorField("target", &CameraSettings::target, "The point that the camera looks at, metres."),
            vectorField("up", &CameraSettings::up, "The direction that is up in the image."),
            field("fov_deg", &CameraSettings::fovDegrees, "Vertical field of view in degrees.", 1.0f, 179.0f),
            vectorField("move", &CameraSettings::move,
                        "How far the camera moves from one frame to the next, metres: "
                        "warm-up frames lead up to `position`, where the first measured frame is taken; "
                        "the others go on from there.")};
    }
};

/// `scene.region`, a box.
struct RegionSettings {
    glm::vec3 min{0.0f};
    glm::vec3 max{0.0f};
    static constexpr auto schema() {
        return std::tuple{vectorField("min", &RegionSettings::min, "Its lowest corner, metres."),
                          vectorField("max", &RegionSettings::max, "Its highest corner, metres.")};
    }
};

/// `off_at` of a light.
template <typename Light>
constexpr auto lightOffField(uint32_t Light::*offAt) {
    return field("off_at", offAt,
                 "The measured frame from which on it does not shine, "
                 "so that one sees how long it stays in the picture; 0: it always shines.",
                 0u, 100000u);
}

/// `move` of a point or spot light.
inline constexpr const char* kLightMoveHelp =
    "How far it moves from one frame to the next, metres: at its place in the compared frame.";

/// Entries of `scene.lights`; the first key is the type of light.
struct DirectionalLightSettings {
    glm::vec3 direction{0, -1, 0};
    glm::vec3 irradiance{1.0f};
    glm::vec3 move{0.0f};
    uint32_t offAt = 0;
    static constexpr auto schema() {
        return std::tuple{
            vectorField("directional", &DirectionalLightSettings::direction,
                        "Direction in which the light travels, of any length but 0."),
            field("irradiance", &DirectionalLightSettings::irradiance,
                  "Irradiance on a surface that faces the light, W/m².", glm::vec3(0.0f), glm::vec3(kMaxLight)),
            vectorField("move", &DirectionalLightSettings::move,
                        "Added to the direction from one frame to the next; "
                        "in the compared frame it shines along `directional`."),
            lightOffField(&DirectionalLightSettings::offAt)};
    }
};
struct PointLightSettings {
    glm::vec3 position{0.0f};
    glm::vec3 intensity{1.0f};
    glm::vec3 move{0.0f};
    uint32_t offAt = 0;
    static constexpr auto schema() {
        return std::tuple{vectorField("point", &PointLightSettings::position, "Position of the light, metres."),
                          field("intensity", &PointLightSettings::intensity, "Radiant intensity, W/sr.",
                                glm::vec3(0.0f), glm::vec3(kMaxLight)),
                          vectorField("move", &PointLightSettings::move, kLightMoveHelp),
                          lightOffField(&PointLightSettings::offAt)};
    }
};
struct SpotLightSettings {
    glm::vec3 position{0.0f};
    glm::vec3 direction{0, -1, 0};
    glm::vec3 intensity{1.0f};
    float innerDegrees = 0;
    float outerDegrees = 45;
    glm::vec3 move{0.0f};
    uint32_t offAt = 0;
    static constexpr auto schema() {
        return std::tuple{
            vectorField("spot", &SpotLightSettings::position, "Position of the light, metres."),
            vectorField("direction", &SpotLightSettings::direction, "Direction of its axis, of any length but 0."),
            field("intensity", &SpotLightSettings::intensity, "Radiant intensity on the axis, W/sr.", glm::vec3(0.0f),
                  glm::vec3(kMaxLight)),
            field("inner_deg", &SpotLightSettings::innerDegrees,
                  "Angle from the axis, in degrees, up to which it has its full intensity.", 0.0f, 90.0f),
            field("outer_deg", &SpotLightSettings::outerDegrees,
                  "Angle from the axis, in degrees, beyond which its intensity is 0.", 0.0f, 90.0f),
            vectorField("move", &SpotLightSettings::move, kLightMoveHelp),
            lightOffField(&SpotLightSettings::offAt)};
    }
};

/// `scene.environment` as a map.
struct EnvironmentSettings {
    std::string map;
    std::string layer;
    glm::vec3 scale{1.0f};
    static constexpr auto schema() {
        return std::tuple{field("map", &EnvironmentSettings::map, "An equirectangular EXR or HDR file, row 0 at +Y."),
                          field("layer", &EnvironmentSettings::layer,
                                "Layer of an EXR map that has several, or the last word of its name."),
                          field("scale", &EnvironmentSettings::scale,
                                "Multiplies the map. A radiance alone, W/(m² sr), stands in place of both keys.",
                                glm::vec3(0.0f), glm::vec3(kMaxLight))};
    }
};

/// A light of the config, in the compared frame.
struct ConfigLight {
    Light light;
    glm::vec3 move{0.0f};  ///< Change in each frame of its position, m, or of a directional light's direction.
    uint32_t offAt = 0;    ///< First frame in which it is off; 0: never.
    TextLocation where;
};

/// An entry of `scene.hide`: the name of a node, mesh or material.
struct HiddenName {
    std::string name;
    TextLocation where;
};

/// `scene`.
struct SceneSettings {
    SceneSource source;
    SceneOptions options;
    std::optional<Placement> placement;  ///< Transform of the source; empty: identity.
    std::vector<SceneAddition> additions;
    std::vector<MaterialOverride> overrides;
    std::vector<HiddenName> hidden;
    std::string cameraName;  ///< Empty: `camera`, else the scene's first camera.
    std::optional<CameraSettings> camera;
    std::vector<ConfigLight> lights;
    std::optional<MovingSpheres> movingSpheres;
    std::optional<RegionSettings> region;            ///< Bounds of voxels and directional light; empty: the scene's.
    std::optional<EnvironmentSettings> environment;  ///< Empty: that of the source.
    TextLocation where, cameraWhere, environmentWhere, regionWhere;
};

/// Reads the block `measure`. @throws UsageError with file, line and the nearest valid word.
MeasureSettings readMeasureSettings(const Value& map);

/// Reads the block `scene`, without file access. @throws UsageError with file, line and the nearest valid
/// word.
SceneSettings readSceneSettings(const Value& map);

/// Whether surfaces or lights move from frame to frame, or a light is switched off.
/// @param isAnimated whether the scene has animations.
bool changesInTime(const SceneSettings& settings, bool isAnimated = true);

/// The first frame in which a light is off; nullopt if none is switched off.
std::optional<uint32_t> firstLightOff(const SceneSettings& settings);

}  // namespace voxray

#include "scene/pbrt/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "base/suggest.h"
#include "scene/import/environment.h"
#include "scene/import/spot_light.h"
#include "scene/luminance.h"
#include "scene/pbrt/equal_area.h"
#include "scene/pbrt/files.h"
#include "scene/pbrt/spectra.h"

namespace voxray::pbrt {
namespace {

using std::numbers::pi;

/// Places +Z along a direction. @throws Error for a direction of length 0
glm::dmat4 alongZ(const glm::dvec3& from, const glm::dvec3& direction, const Parameters& light) {
    const double length = glm::length(direction);
    if (!(length > 0 && std::isfinite(length))) light.fail("its 'from' and 'to' are one point");
    const glm::dvec3 z = direction / length;
    const glm::dvec3 x = glm::normalize(glm::cross(std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), z));
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(from, 1)};
}

/// The factor of a quantity that replaces the light's own strength, if it is given and above 0 as in pbrt.
double factorOf(const Parameters& light, const char* quantity, double ofUnit) {
    const double value = light.number(quantity, -1);
    return value > 0 && ofUnit > 0 ? value / ofUnit : 1;
}

glm::dvec3 meanOf(const ImageF& image) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < image.data.size(); ++i) sum[int(i % 3)] += double(image.data[i]);
    return sum / double(image.pixelCount());
}

voxray::Light makeLight(const Parameters& light, LightType type, const glm::vec3& intensity) {
    voxray::Light made;
    made.name = light.kind + " " + light.place();
    made.type = type;
    made.intensity = intensity;
    return made;
}

/// Illuminance of a surface that faces +Z below a map.
double illuminanceOf(const ImageF& map) {
    double sum = 0;
    for (uint32_t y = 0; y < map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x) {
            const double cosine = directionOfSquare({(x + 0.5) / map.width, (y + 0.5) / map.height}).z;
            const float* p = map.pixel(x, y);
            if (cosine > 0) sum += cosine * double(luminance({p[0], p[1], p[2]}));
        }
    return sum * 4 * pi / double(map.pixelCount());
}

}  // namespace

glm::vec3 Lights::color(const Parameters& light, const std::string& name) {
    const Parameter* parameter = light.find(name);
    return parameter ? emissionOf(*parameter, textures_.folder()) : glm::vec3(1);
}

void Lights::add(const Light& light) {
    using Maker = void (Lights::*)(const Light&);
    static const std::array<std::pair<const char*, Maker>, 6> makers{{{"distant", &Lights::distant},
                                                                      {"goniometric", &Lights::goniometric},
                                                                      {"infinite", &Lights::infinite},
                                                                      {"point", &Lights::point},
                                                                      {"projection", &Lights::projection},
                                                                      {"spot", &Lights::spot}}};
    const std::string& kind = light.parameters->kind;
    std::vector<std::string> kinds;
    for (const auto& [name, maker] : makers) {
        if (kind == name) return (this->*maker)(light);
        kinds.emplace_back(name);
    }
    light.parameters->fail("the light \"{}\" is unknown{}", kind.substr(0, 40), didYouMean(kind, kinds));
}

void Lights::point(const Light& light) {
    const Parameters& p = *light.parameters;
    const double scale = p.number("scale", 1) * factorOf(p, "power", 4 * pi);
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), p.point("from", glm::dvec3(0)));
    import_.addLight(makeLight(p, LightType::Point, color(p, "I") * float(scale)), light.toWorld * place);
}

void Lights::spot(const Light& light) {
    const Parameters& p = *light.parameters;
    const double outer = glm::radians(p.number("coneangle", 30)), edge = glm::radians(p.number("conedeltaangle", 5));
    if (!(outer > 0 && outer <= pi && edge >= 0)) p.fail("'coneangle' is above 0 and at most 180 degrees");
    const double inner = std::max(outer - edge, 0.0);
    const double cosInner = std::cos(inner), cosOuter = std::cos(outer);
    const double unitPower = 2 * pi * ((1 - cosInner) + (cosInner - cosOuter) / 2);
    const double scale = p.number("scale", 1) * factorOf(p, "power", unitPower);
    const auto smooth = [&](double angle) {
        if (cosInner == cosOuter) return angle <= outer ? 1.0 : 0.0;
        const double t = std::clamp((std::cos(angle) - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
        return t * t * (3 - 2 * t);
    };
    voxray::Light made = spotOfEqualPower(color(p, "I") * float(scale), inner, outer, smooth);
    made.name = makeLight(p, LightType::Spot, {}).name;
    import_.notes().add("spots fall off at their edges as glTF's do, with the same power", p.place());
    const glm::dvec3 from = p.point("from", glm::dvec3(0)), to = p.point("to", {0, 0, 1});
    import_.addLight(made, light.toWorld * alongZ(from, to - from, p));
}

void Lights::distant(const Light& light) {
    const Parameters& p = *light.parameters;
    const double scale = p.number("scale", 1) * factorOf(p, "illuminance", 1);
    const glm::dvec3 from = p.point("from", glm::dvec3(0)), to = p.point("to", {0, 0, 1});
    import_.addLight(makeLight(p, LightType::Directional, color(p, "L") * float(scale)),
                     light.toWorld * alongZ(glm::dvec3(0), to - from, p));
}

std::shared_ptr<const ImageF> Lights::squareMap(const Parameters& light) {
    const std::string name = light.text("filename", "");
    if (name.empty()) return nullptr;
    auto map = import_.images().read(textures_.folder() / name, ColorImages::Stored::Srgb);
    if (map && map->width != map->height)
        light.fail(
            "{} has {} x {} pixels; pbrt's maps are equal-area squares: convert others by `imgtool makeequiarea`",
            name.substr(0, 100), map->width, map->height);
    return map;
}

void Lights::infinite(const Light& light) {
    const Parameters& p = *light.parameters;
    if (p.find("portal")) import_.notes().add("portals of lights are left out: light comes from all around", p.place());
    const double scale = p.number("scale", 1);
    if (const auto map = squareMap(p)) return addImageOfSky(light, map, scale);
    const bool isMissing = !p.text("filename", "").empty();
    const double factor = factorOf(p, "illuminance", pi);
    // A grey sky in place of a missing one, as of missing images
    const glm::vec3 radiance = isMissing ? glm::vec3(0.5f) : color(p, "L");
    import_.addEnvironment({radiance * float(scale * factor), nullptr});
}

void Lights::addImageOfSky(const Light& light, const std::shared_ptr<const ImageF>& map, double scale) {
    constexpr uint32_t kMaxHeight = 4096;
    const double factor = scale * factorOf(*light.parameters, "illuminance", illuminanceOf(*map));
    // Our directions to the file's, then to the light's
    const glm::dmat3 toMap(glm::inverse(import_.world() * light.toWorld));
    Environment environment;
    environment.radiance = glm::vec3(float(factor));
    environment.map = environmentMap(
        std::clamp(map->height, 16u, kMaxHeight), toMap, [&](const glm::dvec3& d) { return texelAlong(*map, d); },
        import_.memory());
    import_.addEnvironment(environment);
}

void Lights::goniometric(const Light& light) {
    const Parameters& p = *light.parameters;
    import_.notes().add("'goniometric' lights shine alike in all directions, with the same power", p.place());
    const auto map = squareMap(p);
    const glm::dvec3 mean = map ? meanOf(*map) : glm::dvec3(1);
    const double average = (mean.x + mean.y + mean.z) / 3;
    const double scale = p.number("scale", 1) * factorOf(p, "power", 4 * pi * average);
    import_.addLight(makeLight(p, LightType::Point, color(p, "I") * float(scale * average)), light.toWorld);
}

void Lights::projection(const Light& light) {
    const Parameters& p = *light.parameters;
    import_.notes().add("'projection' lights are spots with the mean of their image", p.place());
    const std::string name = p.text("filename", "");
    const auto image = import_.images().read(textures_.folder() / name, ColorImages::Stored::Srgb);
    const double fov = glm::radians(std::clamp(p.number("fov", 90), 0.1, 179.0));
    const double aspect = image ? double(image->width) / image->height : 1;
    // The cone of the solid angle of the image's pyramid
    const double shortSide = std::tan(fov / 2), longSide = shortSide * std::max(aspect, 1 / aspect);
    const double solidAngle =
        4 * std::asin(shortSide * longSide / std::sqrt((1 + shortSide * shortSide) * (1 + longSide * longSide)));
    const double outer = std::acos(std::clamp(1 - solidAngle / (2 * pi), -1.0, 1.0));
    const glm::vec3 mean = image ? glm::vec3(meanOf(*image)) : glm::vec3(0.5f);
    const double scale = p.number("scale", 1) * factorOf(p, "power", solidAngle * double(luminance(mean)));
    voxray::Light made = spotOfEqualPower(mean * float(scale), outer, outer, [](double) { return 1.0; });
    made.name = makeLight(p, LightType::Spot, {}).name;
    import_.addLight(made, light.toWorld);
}

SurfaceEmission Lights::emission(const Parameters& areaLight, double area) {
    SurfaceEmission emission;
    emission.twoSided = areaLight.flag("twosided", false);
    const std::string file = areaLight.text("filename", "");
    double unit = 1;
    if (!file.empty()) {
        const auto image = textures_.image(file, ColorImages::Stored::Srgb);
        emission.radiance = image ? glm::vec3(1) : glm::vec3(0.5f);
        emission.radiance.image = image;
        unit = double(luminance(emission.radiance.mean()));
    } else {
        emission.radiance.value = color(areaLight, "L");
    }
    const double sides = emission.twoSided ? 2 : 1;
    emission.radiance.value *=
        float(areaLight.number("scale", 1) * factorOf(areaLight, "power", unit * sides * area * pi));
    return emission;
}

}  // namespace voxray::pbrt

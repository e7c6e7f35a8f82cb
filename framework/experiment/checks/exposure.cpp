#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "base/hex_color.h"
#include "experiment/checks/checks.h"

namespace voxray {
namespace {

constexpr float kWhite = 4;              ///< Two stops over the maximum of previews.
constexpr double kNearlyAll = 0.9;       ///< Fraction of the view's contents.
constexpr float kMinByteRadiance = 32;   ///< Smallest radiance that may be a color of 0 to 255.
constexpr double kStepsOfBlack = 0.5;    ///< In units of 8-bit values.
constexpr double kSlopeAtBlack = 12.92;  ///< That of the sRGB curve.

double scaleOf(float exposureStops) {
    return std::exp2(double(exposureStops));
}

double meanOf(const ImageF& view, double contentFraction) {
    return std::accumulate(view.data.begin(), view.data.end(), 0.0) / double(view.data.size()) / contentFraction;
}

/// The mean of each pixel's channels, sorted.
std::vector<float> brightnesses(const ImageF& view) {
    std::vector<float> means;
    for (size_t i = 0; i < view.data.size(); i += 3)
        means.push_back((view.data[i] + view.data[i + 1] + view.data[i + 2]) / 3);
    std::ranges::sort(means);
    return means;
}

/// A hint for a radiance that is probably a color of 0 to 255, else "".
std::string fromBytes(const glm::vec3& radiance) {
    const bool isWhole = glm::all(glm::equal(radiance, glm::round(radiance)));
    const float largest = std::max({radiance.x, radiance.y, radiance.z});
    if (!isWhole || largest < kMinByteRadiance || largest > 255) return {};
    return fmt::format(
        "as a color of 0 to 255 it is {}",
        linearTriple(fmt::format("#{:02x}{:02x}{:02x}", int(radiance.x), int(radiance.y), int(radiance.z))));
}

/// The lights of the config, and the location of the first one.
struct ConfigLights {
    std::vector<std::string> names;
    TextLocation where;
    std::string hint;
};

ConfigLights lightsIn(const SceneSettings& scene) {
    ConfigLights lights;
    const auto add = [&](std::string name, const TextLocation& where) {
        if (lights.names.empty()) lights.where = where;
        lights.names.push_back(std::move(name));
    };
    if (scene.environment && scene.environment->scale != glm::vec3(0.0f)) {
        add("scene.environment", scene.environmentWhere);
        if (scene.environment->map.empty()) lights.hint = fromBytes(scene.environment->scale);
    }
    for (size_t i = 0; i < scene.lights.size(); ++i)
        if (scene.lights[i].light.intensity != glm::vec3(0.0f))
            add(fmt::format("scene.lights[{}]", i), scene.lights[i].where);
    if (lights.names.empty()) add("scene", scene.where);
    return lights;
}

/// A factor rounded to one digit, without an exponent if it is short.
std::string roundly(double factor) {
    const double digit = std::pow(10.0, std::floor(std::log10(factor)));
    const double rounded = std::round(factor / digit) * digit;
    return rounded < 1e6 ? fmt::format("{:.6g}", rounded) : fmt::format("{:.0e}", rounded);
}

/// A diagnostic of a view that is nearly all white or black, with a factor for lights and an exposure.
Diagnostic nearlyAll(const Setup& setup, double radiance, const char* color) {
    constexpr float kMaxStops = 30;
    const ConfigLights lights = lightsIn(setup.scene);
    const float stops = setup.image.exposureStops;
    const double factor = radiance * scaleOf(stops) / kPreviewRadiance;
    std::vector<std::string> remedies;
    if (lights.names.front() != "scene")
        remedies.push_back(fmt::format("{} it by about {}", factor > 1 ? "divide" : "multiply",
                                       roundly(std::max(factor, 1 / factor))));
    if (const double wanted = std::round(double(stops) - std::log2(factor)); std::abs(wanted) <= kMaxStops)
        remedies.push_back(fmt::format("write image: {{exposure_stops: {}}}", int(wanted)));
    std::string advice = fmt::format("{}", fmt::join(remedies, ", or "));
    if (factor > 1 && !lights.hint.empty()) advice += "; " + lights.hint;
    return {lights.where,
            fmt::format("{}: nearly all of the view is {}: "
                        "its radiance is about {:.2g} W/(m² sr), and {:.3g} is white at exposure_stops: {:g}",
                        fmt::join(lights.names, ", "), color, radiance, 1 / scaleOf(stops), stops),
            advice};
}

}  // namespace

bool isDarkAt(float exposureStops, const ImageF& view, double contentFraction) {
    return meanOf(view, contentFraction) * scaleOf(exposureStops) < kStepsOfBlack / 255 / kSlopeAtBlack;
}

/// Warns of a view that is nearly all black in previews, or white by two stops or more, e.g. if lights are
/// given in other units.
void extremeExposure(const View& view, Diagnostics& found) {
    if (view.isEmpty || isBlack(view.image)) return;
    const float stops = view.setup.image.exposureStops;
    if (isDarkAt(stops, view.image, view.contentFraction())) {
        found.push_back(nearlyAll(view.setup, meanOf(view.image, view.contentFraction()), "black"));
        return;
    }
    const std::vector<float> means = brightnesses(view.image);
    const auto isWhite = [&](float value) { return double(value) * scaleOf(stops) > double(kWhite); };
    const auto white = std::ranges::find_if(means, isWhite);
    const size_t count = size_t(means.end() - white);
    if (double(count) >= kNearlyAll * view.contentFraction() * double(means.size()))
        found.push_back(nearlyAll(view.setup, double(white[std::ptrdiff_t(count / 2)]), "white"));
}

}  // namespace voxray

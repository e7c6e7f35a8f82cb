#include "scene/import/spot_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxray {
namespace {

/// Widest cone of KHR_lights_punctual, and the least difference between its angles, so that its edge is one.
constexpr double kMaxAngle = std::numbers::pi / 2;
constexpr double kLeastEdge = 1e-3;

/// ∫ falloff sin over the cone, by the midpoint rule.
double power(double outer, const std::function<double(double)>& falloff) {
    constexpr int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = outer * (i + 0.5) / steps;
        sum += falloff(angle) * std::sin(angle) * outer / steps;
    }
    return sum;
}

}  // namespace

Light spotOfEqualPower(const glm::vec3& intensity, double inner, double outer,
                       const std::function<double(double)>& falloff) {
    Light light;
    light.type = LightType::Spot;
    const double wide = std::clamp(outer, 2 * kLeastEdge, kMaxAngle);
    const double narrow = std::clamp(inner, 0.0, wide - kLeastEdge);
    light.outerConeAngle = float(wide);
    light.innerConeAngle = float(narrow);
    const double cosInner = std::cos(narrow), cosOuter = std::cos(wide);
    const double ours = power(wide, [&](double angle) {
        const double t = std::clamp((std::cos(angle) - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
        return t * t;
    });
    const double theirs = power(std::clamp(outer, 2 * kLeastEdge, std::numbers::pi), falloff);
    light.intensity = intensity * float(theirs / ours);
    return light;
}

}  // namespace voxray

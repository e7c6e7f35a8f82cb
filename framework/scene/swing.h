#pragma once

#include "base/schema.h"
#include "scene/scene.h"

namespace voxray {

/// Oscillation along a line: by a vector, back, as far in the opposite direction and back again, at constant
/// speed.
struct Swing {
    glm::vec3 by{0.0f};
    float period = 4.0f;
    static constexpr auto schema() {
        return std::tuple{field("by", &Swing::by, "Vector that it moves by; then as far in the opposite direction, m.",
                                glm::vec3(-1e4f), glm::vec3(1e4f))
                              .asVector(),
                          field("period", &Swing::period, "Duration of a whole oscillation, s.", 0.001f, 1e6f)};
    }
};

/// The translation of a node that is at `center` at time 0.
inline AnimationChannel translationOf(const Swing& swing, uint32_t node, const glm::vec3& center) {
    const glm::vec4 from(center, 0), by(swing.by, 0);
    return {node,
            AnimatedProperty::Translation,
            Interpolation::Linear,
            {0, 0.25f * swing.period, 0.75f * swing.period, swing.period},
            {from, from + by, from - by, from}};
}

}  // namespace voxray

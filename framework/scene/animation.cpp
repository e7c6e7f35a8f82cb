#include "scene/animation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"

namespace voxray {
namespace {

glm::quat toQuat(const glm::vec4& v) {
    return glm::quat(v.w, v.x, v.y, v.z);
}

glm::vec4 normalizedOr(const glm::vec4& v, const glm::vec4& fallback) {
    const float length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : fallback;
}

glm::mat4 localMatrix(const Node& node) {
    if (node.matrix) return *node.matrix;
    glm::mat4 m = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis) m[axis] *= node.scale[axis];
    m[3] = glm::vec4(node.translation, 1.0f);
    return m;
}

bool isFinite(const glm::mat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

}  // namespace

glm::vec4 sampleChannel(const AnimationChannel& channel, double timeSeconds) {
    assert(!channel.timesSeconds.empty());
    const std::vector<float>& times = channel.timesSeconds;
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    const bool rotation = channel.property == AnimatedProperty::Rotation;
    const auto value = [&](size_t key) { return channel.values[cubic ? 3 * key + 1 : key]; };

    // The keys around the time, clamped.
    const size_t next = size_t(std::upper_bound(times.begin(), times.end(), timeSeconds) - times.begin());
    if (next == 0) return value(0);
    if (next == times.size() || channel.interpolation == Interpolation::Step) return value(next - 1);
    const size_t previous = next - 1;
    const double span = double(times[next]) - double(times[previous]);
    const float t = float((timeSeconds - double(times[previous])) / span);

    // Linear, rotations along the shorter arc.
    if (!cubic) {
        if (!rotation) return glm::mix(value(previous), value(next), t);
        const glm::quat q = glm::slerp(toQuat(value(previous)), toQuat(value(next)), t);
        return normalizedOr(glm::vec4(q.x, q.y, q.z, q.w), value(previous));
    }

    // Hermite spline; tangents are per second.
    const float t2 = t * t;
    const float t3 = t2 * t;
    const glm::vec4 out = channel.values[3 * previous + 2] * float(span);
    const glm::vec4 in = channel.values[3 * next] * float(span);
    const glm::vec4 sum = (2 * t3 - 3 * t2 + 1) * value(previous) + (t3 - 2 * t2 + t) * out +
                          (-2 * t3 + 3 * t2) * value(next) + (t3 - t2) * in;
    return rotation ? normalizedOr(sum, value(previous)) : sum;
}

std::vector<glm::mat4> nodeToWorld(const Scene& scene, double timeSeconds) {
    // Set the nodes' transforms.
    std::vector<Node> nodes = scene.nodes;
    for (const AnimationChannel& channel : scene.animation) {
        const glm::vec4 v = sampleChannel(channel, timeSeconds);
        Node& node = nodes[channel.node];
        switch (channel.property) {
            case AnimatedProperty::Translation:
                node.translation = glm::vec3(v);
                break;
            case AnimatedProperty::Rotation:
                node.rotation = toQuat(v);
                break;
            case AnimatedProperty::Scale:
                node.scale = glm::vec3(v);
                break;
        }
    }

    // Multiply down the hierarchy; parents precede children.
    std::vector<glm::mat4> world(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const int32_t parent = nodes[i].parent;
        assert(parent < int32_t(i));
        world[i] = parent < 0 ? localMatrix(nodes[i]) : world[size_t(parent)] * localMatrix(nodes[i]);
        if (!isFinite(world[i]))
            throw Error("{}: the transform of node {} '{}' is not finite at {} s; correct it in the file", scene.name,
                        i, nodes[i].name, timeSeconds);
    }
    return world;
}

double loopedTime(const Scene& scene, double timeSeconds) {
    double end = 0;
    for (const AnimationChannel& channel : scene.animation) end = std::max(end, double(channel.timesSeconds.back()));
    if (!(end > 0)) return 0;
    const double time = std::fmod(timeSeconds, end);
    return time < 0 ? time + end : time;
}

}  // namespace voxray

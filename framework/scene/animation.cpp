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

/// Where a time lies between two keys; at a key, `previous` and `next` are the same.
struct KeySpan {
    size_t previous = 0, next = 0;
    float t = 0;        ///< From 0 at `previous` to 1 at `next`.
    float seconds = 0;  ///< From one to the other.
};

/// The keys around a time, which is clamped to them.
KeySpan spanAt(const std::vector<float>& times, Interpolation interpolation, double timeSeconds) {
    assert(!times.empty());
    const size_t next = size_t(std::upper_bound(times.begin(), times.end(), timeSeconds) - times.begin());
    if (next == 0) return {};
    const size_t previous = next - 1;
    if (next == times.size() || interpolation == Interpolation::Step) return {previous, previous};
    const double seconds = double(times[next]) - double(times[previous]);
    return {previous, next, float((timeSeconds - double(times[previous])) / seconds), float(seconds)};
}

/// A Hermite spline. @param out,in tangents per second at its ends. T: a float or a vector.
template <typename T>
T hermite(const KeySpan& span, const T& from, const T& out, const T& to, const T& in) {
    const float t = span.t, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * from + (t3 - 2 * t2 + t) * (out * span.seconds) + (-2 * t3 + 3 * t2) * to +
           (t3 - t2) * (in * span.seconds);
}

}  // namespace

glm::vec4 sampleChannel(const AnimationChannel& channel, double timeSeconds) {
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    const bool rotation = channel.property == AnimatedProperty::Rotation;
    const auto value = [&](size_t key) { return channel.values[cubic ? 3 * key + 1 : key]; };
    const KeySpan span = spanAt(channel.timesSeconds, channel.interpolation, timeSeconds);
    const glm::vec4 from = value(span.previous), to = value(span.next);
    if (span.previous == span.next) return from;

    // Linear, rotations along the shorter arc.
    if (!cubic) {
        if (!rotation) return glm::mix(from, to, span.t);
        const glm::quat q = glm::slerp(toQuat(from), toQuat(to), span.t);
        return normalizedOr(glm::vec4(q.x, q.y, q.z, q.w), from);
    }
    const glm::vec4 sum = hermite(span, from, channel.values[3 * span.previous + 2], to, channel.values[3 * span.next]);
    return rotation ? normalizedOr(sum, from) : sum;
}

std::vector<float> sampleWeights(const MorphChannel& channel, double timeSeconds) {
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    const KeySpan span = spanAt(channel.timesSeconds, channel.interpolation, timeSeconds);
    std::vector<float> weights(channel.targetCount);
    for (size_t t = 0; t < weights.size(); ++t) {
        const auto value = [&](size_t key, size_t part) {
            return channel.values[(cubic ? 3 * key + part : key) * weights.size() + t];
        };
        const float from = value(span.previous, 1), to = value(span.next, 1);
        if (span.previous == span.next)
            weights[t] = from;
        else if (cubic)
            weights[t] = hermite(span, from, value(span.previous, 2), to, value(span.next, 0));
        else
            weights[t] = glm::mix(from, to, span.t);
    }
    return weights;
}

bool isAnimated(const Scene& scene) {
    return !scene.animation.empty() || !scene.morphs.empty();
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
    for (const MorphChannel& channel : scene.morphs) end = std::max(end, double(channel.timesSeconds.back()));
    if (!(end > 0)) return 0;
    const double time = std::fmod(timeSeconds, end);
    return time < 0 ? time + end : time;
}

}  // namespace voxray

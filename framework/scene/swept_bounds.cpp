#include "scene/swept_bounds.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>

#include "scene/morph.h"

namespace voxray {
namespace {

Box hullOf(const std::vector<glm::vec3>& points) {
    Box hull = Box::empty();
    for (const glm::vec3& point : points) hull.include(point);
    return hull;
}

/// Bounds of a box under an affine transform.
Box transformed(const Box& box, const glm::mat3& linear, const glm::vec3& offset) {
    Box out{offset, offset};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 a = linear[axis] * box.min[axis], b = linear[axis] * box.max[axis];
        out.min += glm::min(a, b);
        out.max += glm::max(a, b);
    }
    return out;
}

bool changes(const AnimationChannel& channel) {
    return std::any_of(channel.values.begin(), channel.values.end(),
                       [&](const glm::vec4& value) { return value != channel.values[0]; });
}

/// Bounds of an animated vector; a spline lies in the hull of its Bezier control points.
Box valuesOf(const AnimationChannel& channel) {
    std::vector<glm::vec3> points;
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    for (size_t key = 0; key < channel.timesSeconds.size(); ++key) {
        points.emplace_back(channel.values[cubic ? 3 * key + 1 : key]);
        if (!cubic || key == 0) continue;
        const float third = (channel.timesSeconds[key] - channel.timesSeconds[key - 1]) / 3;
        points.emplace_back(channel.values[3 * key - 2] + third * channel.values[3 * key - 1]);
        points.emplace_back(channel.values[3 * key + 1] - third * channel.values[3 * key]);
    }
    return hullOf(points);
}

/// Ranges of a node's properties; no rotation: any.
struct NodeRange {
    Box translation, scale;
    std::optional<glm::quat> rotation;
};

NodeRange rangeOf(const Scene& scene, uint32_t index) {
    const Node& node = scene.nodes[index];
    NodeRange range{{node.translation, node.translation}, {node.scale, node.scale}, node.rotation};
    for (const AnimationChannel& channel : scene.animation) {
        if (channel.node != index) continue;
        if (channel.property == AnimatedProperty::Translation)
            range.translation = valuesOf(channel);
        else if (channel.property == AnimatedProperty::Scale)
            range.scale = valuesOf(channel);
        else
            range.rotation.reset();
    }
    return range;
}

/// Bounds in the space of the node's parent over all times.
Box swept(const Box& box, const Scene& scene, uint32_t index) {
    if (const auto& matrix = scene.nodes[index].matrix)
        return transformed(box, glm::mat3(*matrix), glm::vec3((*matrix)[3]));
    const NodeRange range = rangeOf(scene, index);
    Box out = hullOf(
        {box.min * range.scale.min, box.min * range.scale.max, box.max * range.scale.min, box.max * range.scale.max});
    if (range.rotation) {
        out = transformed(out, glm::mat3_cast(*range.rotation), glm::vec3(0.0f));
    } else {
        const float radius = glm::length(glm::max(glm::abs(out.min), glm::abs(out.max)));
        out = {glm::vec3(-radius), glm::vec3(radius)};
    }
    return {out.min + range.translation.min, out.max + range.translation.max};
}

Box sweptToWorld(Box box, const Scene& scene, int32_t node) {
    for (; node >= 0; node = scene.nodes[size_t(node)].parent) box = swept(box, scene, uint32_t(node));
    return box;
}

bool nodeMoves(const Scene& scene, int32_t node) {
    for (; node >= 0; node = scene.nodes[size_t(node)].parent)
        for (const AnimationChannel& channel : scene.animation)
            if (channel.node == uint32_t(node) && changes(channel)) return true;
    return false;
}

/// Calls visit(positions) with the mesh's positions in shapes whose hull holds those of all times.
template <typename Visit>
void visitShapes(const Scene& scene, const Instance& instance, const Visit& visit) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (instance.morph < 0) return visit(mesh.positions);
    for (const std::vector<float>& weights : hullOfWeights(scene.morphs[size_t(instance.morph)]))
        visit(morphedPositions(mesh, weights));
}

/// Bounds of each joint's vertices, in its node's space.
std::vector<Box> jointHulls(const Scene& scene, const Instance& instance) {
    const Skin& skin = scene.skins[size_t(instance.skin)];
    std::vector<Box> hulls(skin.joints.size(), Box::empty());
    visitShapes(scene, instance, [&](const std::vector<glm::vec3>& positions) {
        for (const SkinWeights& set : scene.meshes[instance.mesh].skinWeights)
            for (size_t v = 0; v < positions.size(); ++v)
                for (int i = 0; i < 4; ++i) {
                    if (!(set.weights[v][i] > 0)) continue;
                    const uint32_t joint = set.joints[v][i];
                    const glm::vec4 p = skin.inverseBindMatrices[joint] * glm::vec4(positions[v], 1.0f);
                    hulls[joint].include(glm::vec3(p));
                }
    });
    return hulls;
}

}  // namespace

bool movesInTime(const Scene& scene, const Instance& instance) {
    if (instance.morph >= 0 && changes(scene.morphs[size_t(instance.morph)])) return true;
    if (instance.skin < 0) return nodeMoves(scene, instance.node);
    const std::vector<uint32_t>& joints = scene.skins[size_t(instance.skin)].joints;
    return std::any_of(joints.begin(), joints.end(), [&](uint32_t joint) { return nodeMoves(scene, int32_t(joint)); });
}

Box sweptBounds(const Scene& scene, const Instance& instance) {
    Box box = Box::empty();
    if (instance.skin < 0) {
        visitShapes(scene, instance, [&](const std::vector<glm::vec3>& positions) { box.include(hullOf(positions)); });
        box = sweptToWorld(box, scene, instance.node);
    } else {
        // A blend with weights that sum to 1 lies in the hull of the vertices transformed by single joints.
        const Skin& skin = scene.skins[size_t(instance.skin)];
        const std::vector<Box> hulls = jointHulls(scene, instance);
        for (size_t i = 0; i < hulls.size(); ++i) {
            if (hulls[i].min.x > hulls[i].max.x) continue;
            box.include(sweptToWorld(hulls[i], scene, int32_t(skin.joints[i])));
        }
    }

    // Rounding of the vertex transform.
    const glm::vec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
    const float margin = 1e-5f * std::max({largest.x, largest.y, largest.z});
    return {box.min - margin, box.max + margin};
}

}  // namespace voxray

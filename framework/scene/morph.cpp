#include "scene/morph.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "scene/mesh_repair.h"

namespace voxray {
namespace {

constexpr size_t kMorphGrain = 16384;

/// An attribute with each target's displacements times its weight.
template <typename Vector>
std::vector<Vector> displaced(std::vector<Vector> values, const MorphTargets& morph, const std::vector<float>& weights,
                              std::vector<glm::vec3> MorphTarget::*attribute) {
    assert(weights.size() == morph.targets.size());
    for (size_t t = 0; t < weights.size(); ++t) {
        const std::vector<glm::vec3>& offsets = morph.targets[t].*attribute;
        if (weights[t] == 0 || offsets.empty()) continue;
        parallelRanges(values.size(), kMorphGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                for (int c = 0; c < 3; ++c) values[i][c] += weights[t] * offsets[i][c];
        });
    }
    return values;
}

/// The unit vector, or the fallback where there is none.
glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& fallback) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : fallback;
}

/// Weights of a key. @param part of a spline's key: 0 in-tangents, 1 weights, 2 out-tangents; else 0.
std::vector<float> keyWeights(const MorphChannel& channel, size_t key, size_t part) {
    const size_t parts = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
    const auto first = channel.values.begin() + ptrdiff_t((parts * key + part) * channel.targetCount);
    return {first, first + channel.targetCount};
}

/// a + factor * b.
std::vector<float> sumOf(std::vector<float> a, float factor, const std::vector<float>& b) {
    for (size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
    return a;
}

}  // namespace

std::vector<glm::vec3> morphedPositions(const Mesh& mesh, const std::vector<float>& weights) {
    return displaced(mesh.positions, mesh.morph, weights, &MorphTarget::positions);
}

MorphedShape morphed(const Mesh& mesh, const std::vector<float>& weights) {
    MorphedShape shape;
    shape.positions = morphedPositions(mesh, weights);
    if (mesh.morph.hasFlatNormals) {
        shape.normals = flatNormals(shape.positions, mesh.triangles);
    } else {
        shape.normals = displaced(mesh.normals, mesh.morph, weights, &MorphTarget::normals);
        for (size_t i = 0; i < shape.normals.size(); ++i)
            shape.normals[i] = unitOr(glm::dvec3(shape.normals[i]), mesh.normals[i]);
    }
    if (mesh.morph.tangentTexCoords) {
        shape.tangents = tangentsOf(mesh, shape.positions, shape.normals, *mesh.morph.tangentTexCoords);
    } else {
        shape.tangents = displaced(mesh.tangents, mesh.morph, weights, &MorphTarget::tangents);
        for (size_t i = 0; i < shape.tangents.size(); ++i) {
            const glm::vec4 rest = mesh.tangents[i];
            shape.tangents[i] = glm::vec4(unitOr(glm::dvec3(shape.tangents[i]), glm::vec3(rest)), rest.w);
        }
    }
    return shape;
}

bool changes(const MorphChannel& channel) {
    const std::vector<std::vector<float>> weights = hullOfWeights(channel);
    return std::ranges::any_of(weights, [&](const std::vector<float>& w) { return w != weights[0]; });
}

std::vector<std::vector<float>> hullOfWeights(const MorphChannel& channel) {
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    std::vector<std::vector<float>> hull;
    for (size_t key = 0; key < channel.timesSeconds.size(); ++key) {
        hull.push_back(keyWeights(channel, key, cubic ? 1 : 0));
        if (!cubic || key == 0) continue;
        const float third = (channel.timesSeconds[key] - channel.timesSeconds[key - 1]) / 3;
        hull.push_back(sumOf(keyWeights(channel, key - 1, 1), third, keyWeights(channel, key - 1, 2)));
        hull.push_back(sumOf(keyWeights(channel, key, 1), -third, keyWeights(channel, key, 0)));
    }
    return hull;
}

}  // namespace voxray

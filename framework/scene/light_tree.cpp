#include "scene/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "scene/luminance.h"

namespace voxray {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kBelowOne = 0x1.fffffep-1f;

/// Directions within an angle of an axis.
struct Cone {
    glm::dvec3 axis{0, 0, 1};
    double angle = kPi, cosine = -1, sine = 0;  ///< All directions.

    Cone() = default;
    Cone(const glm::dvec3& of, double half) : axis(of), angle(half), cosine(std::cos(half)), sine(std::sin(half)) {}
};

/// A cone that holds both (Conty Estevez and Kulla 2018, algorithm 1).
Cone unite(const Cone& one, const Cone& other) {
    const Cone &a = one.angle < other.angle ? other : one, &b = one.angle < other.angle ? one : other;
    const double alike = glm::dot(a.axis, b.axis);
    if (a.angle >= kPi || alike >= a.cosine * b.cosine + a.sine * b.sine) return a;
    const glm::dvec3 across = glm::cross(a.axis, b.axis);
    const double sine = glm::length(across), between = std::atan2(sine, alike);
    if (between + b.angle <= a.angle) return a;
    const double angle = 0.5 * (a.angle + between + b.angle);
    if (angle >= kPi || !(sine > 0)) return {};
    // Rodrigues' formula; `across` is perpendicular to the axis
    const double turn = angle - a.angle;
    return {std::cos(turn) * a.axis + std::sin(turn) * glm::cross(across / sine, a.axis), angle};
}

/// Bounds of some lights.
struct Cluster {
    Box bounds = Box::empty();
    double intensity = 0;
    Cone cone{};
    double emission = 0;  ///< Radians.
    bool doubleSided = false;

    static Cluster of(const BoundedLight& l) {
        const double orientation = std::acos(double(l.cosOrientation));
        return {
            l.bounds, l.intensity, {glm::dvec3(l.axis), orientation}, std::acos(double(l.cosEmission)), l.doubleSided};
    }
    bool empty() const { return !(intensity > 0); }
    void add(const Cluster& other) {
        if (other.empty()) return;
        cone = empty() ? other.cone : unite(cone, other.cone);
        bounds.include(other.bounds);
        intensity += other.intensity;
        emission = std::max(emission, other.emission);
        doubleSided = doubleSided || other.doubleSided;
    }

    /// Surface area orientation heuristic (section 4.4), with the squared diagonal of the bounds for their area, as
    /// the importance depends on the radius of the bounds. Lights on a line then have a cost, too.
    double cost() const {
        if (empty()) return 0;
        const double o = cone.angle, w = std::min(o + emission, kPi);
        const double directions =
            2 * kPi * (1 - cone.cosine) +
            0.5 * kPi * (2 * w * cone.sine - std::cos(o - 2 * w) - 2 * o * cone.sine + cone.cosine);
        const glm::dvec3 diagonal = bounds.max - bounds.min;
        return intensity * directions * glm::dot(diagonal, diagonal);
    }
};

struct Item {
    Cluster cluster;
    glm::vec3 center;
    uint32_t light;
};

/// Builds nodes depth first.
class Builder {
 public:
    Builder(std::span<const BoundedLight> lights, double intensity, std::vector<gpu::LightTreeNode>& nodes,
            std::vector<uint32_t>& leaves)
        : lights_(lights), intensity_(intensity), nodes_(nodes), leaves_(leaves) {
        for (uint32_t i = 0; i < lights.size(); ++i)
            items_.push_back({Cluster::of(lights[i]), 0.5f * (lights[i].bounds.min + lights[i].bounds.max), i});
    }

    /// Builds the tree of items [first, last). @param split of the root; 0: where it costs least.
    void build(size_t first, size_t last, uint32_t parent, size_t split) {
        const auto index = uint32_t(nodes_.size());
        nodes_.push_back(node(first, last, parent));
        if (last - first == 1) {
            const uint32_t light = items_[first].light;
            leaves_[light] = index;
            nodes_[index].link = LIGHT_TREE_LEAF | lights_[light].id;
            return;
        }
        const size_t middle = split > 0 ? split : partition(first, last);
        build(first, middle, index, 0);
        nodes_[index].link = uint32_t(nodes_.size());
        build(middle, last, index, 0);
    }

 private:
    static constexpr size_t kBuckets = 12;

    gpu::LightTreeNode node(size_t first, size_t last, uint32_t parent) const {
        Cluster all;
        for (size_t i = first; i < last; ++i) all.add(items_[i].cluster);
        return {all.bounds.min,
                float(all.intensity / intensity_),
                all.bounds.max,
                float(all.cone.cosine),
                glm::vec3(all.cone.axis),
                float(std::cos(all.emission)),
                0,
                parent,
                all.doubleSided ? 1u : 0u};
    }

    /// Sorts items into two halves of least cost. @return the first of the second half.
    size_t partition(size_t first, size_t last) {
        Box centers = Box::empty(), bounds = Box::empty();
        for (size_t i = first; i < last; ++i) {
            centers.include(items_[i].center);
            bounds.include(items_[i].cluster.bounds);
        }
        const glm::vec3 size = bounds.max - bounds.min;
        double best = std::numeric_limits<double>::infinity();
        int bestAxis = -1;
        size_t bestBucket = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(centers.max[axis] > centers.min[axis])) continue;
            std::array<Cluster, kBuckets> buckets;
            for (size_t i = first; i < last; ++i)
                buckets[bucketOf(centers, axis, items_[i].center)].add(items_[i].cluster);
            std::array<double, kBuckets> above{};
            Cluster sum;
            for (size_t b = kBuckets - 1; b > 0; --b) {
                sum.add(buckets[b]);
                above[b] = sum.cost();
            }
            // Splits across short sides cost more
            const double aspect = double(std::max({size.x, size.y, size.z})) / double(std::max(size[axis], 1e-30f));
            sum = {};
            for (size_t b = 1; b < kBuckets; ++b) {
                sum.add(buckets[b - 1]);
                const double cost = aspect * (sum.cost() + above[b]);
                if (cost < best) {
                    best = cost;
                    bestAxis = axis;
                    bestBucket = b;
                }
            }
        }
        if (bestAxis < 0) return (first + last) / 2;
        const auto begin = items_.begin() + ptrdiff_t(first), end = items_.begin() + ptrdiff_t(last);
        const auto middle = std::stable_partition(
            begin, end, [&](const Item& item) { return bucketOf(centers, bestAxis, item.center) < bestBucket; });
        return middle == begin || middle == end ? (first + last) / 2 : size_t(middle - items_.begin());
    }

    static size_t bucketOf(const Box& centers, int axis, const glm::vec3& center) {
        const double at = (double(center[axis]) - double(centers.min[axis])) /
                          (double(centers.max[axis]) - double(centers.min[axis]));
        return std::min(size_t(at * double(kBuckets)), kBuckets - 1);
    }

    std::span<const BoundedLight> lights_;
    double intensity_;
    std::vector<Item> items_;
    std::vector<gpu::LightTreeNode>& nodes_;
    std::vector<uint32_t>& leaves_;
};

}  // namespace

std::optional<BoundedLight> boundedLight(const Light& light, uint32_t id) {
    const double intensity = luminance(light.intensity);
    if (light.type == LightType::Directional || !(intensity > 0)) return {};
    BoundedLight bounded{.id = id, .bounds = {light.position, light.position}, .intensity = intensity};
    if (light.type == LightType::Spot) {
        bounded.axis = light.direction;
        bounded.cosEmission = std::max(std::cos(light.outerConeAngle), 0.0f);
    } else {
        bounded.cosOrientation = -1;
    }
    return bounded;
}

BoundedLight boundedLight(std::span<const glm::vec3> corners, const glm::vec3& normal, double area, double radiance,
                          bool doubleSided, uint32_t id) {
    Box bounds = Box::empty();
    for (const glm::vec3& corner : corners) bounds.include(corner);
    return {.id = id, .bounds = bounds, .intensity = radiance * area, .axis = normal, .doubleSided = doubleSided};
}

LightTree::LightTree(std::span<const BoundedLight> lights, size_t firstGroup) : leaves_(lights.size()) {
    if (lights.empty()) return;
    for (const BoundedLight& light : lights) intensity_ += light.intensity;
    nodes_.reserve(2 * lights.size() - 1);
    Builder(lights, intensity_, nodes_, leaves_)
        .build(0, lights.size(), 0, firstGroup < lights.size() ? firstGroup : 0);
}

float LightTree::importance(uint32_t node, const glm::vec3& position, const glm::vec3& normal) const {
    const uint32_t second = nodes_[node].link;
    if ((second & LIGHT_TREE_LEAF) != 0) return gpu::lightTreeImportance(nodes_[node], position, normal);
    return gpu::lightTreeImportance(nodes_[node + 1], position, normal) +
           gpu::lightTreeImportance(nodes_[second], position, normal);
}

float LightTree::irradiance(const glm::vec3& position, const glm::vec3& normal) const {
    return empty() ? 0.0f : float(intensity_ * double(importance(0, position, normal)));
}

LightTree::Pick LightTree::pick(const glm::vec3& position, const glm::vec3& normal, float u) const {
    float probability = 1.0f;
    uint32_t node = 0;
    while ((nodes_[node].link & LIGHT_TREE_LEAF) == 0) {
        const uint32_t second = nodes_[node].link;
        const float a = importance(node + 1, position, normal), b = importance(second, position, normal);
        if (!(a + b > 0.0f)) return {};
        const float first = a / (a + b);
        if (u < first) {
            u /= first;
            probability *= first;
            ++node;
        } else {
            u = (u - first) / (1.0f - first);
            probability *= b / (a + b);
            node = second;
        }
        u = std::min(u, kBelowOne);
    }
    return {nodes_[node].link & ~LIGHT_TREE_LEAF, probability};
}

float LightTree::probability(uint32_t leaf, const glm::vec3& position, const glm::vec3& normal) const {
    float probability = 1.0f;
    for (uint32_t node = leaf; node != 0; node = nodes_[node].parent) {
        const uint32_t first = nodes_[node].parent + 1, second = nodes_[nodes_[node].parent].link;
        const float a = importance(first, position, normal), b = importance(second, position, normal);
        if (!(a + b > 0.0f)) return 0.0f;
        probability *= (node == first ? a : b) / (a + b);
    }
    return probability;
}

}  // namespace voxray

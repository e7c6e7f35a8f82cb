#include "scene/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "scene/luminance.h"

namespace voxray {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

/// Directions within an angle of an axis.
struct Cone {
    glm::dvec3 axis{0, 0, 1};
    double angle = std::numbers::pi, cosine = -1, sine = 0;  ///< All directions.

    Cone() = default;
    Cone(const glm::dvec3& of, double half) : axis(of), angle(half), cosine(std::cos(half)), sine(std::sin(half)) {}
};

/// A cone that holds both (Conty Estevez and Kulla 2018, algorithm 1).
Cone unite(const Cone& one, const Cone& other) {
    const Cone &a = one.angle < other.angle ? other : one, &b = one.angle < other.angle ? one : other;
    const double alike = glm::dot(a.axis, b.axis);
    if (a.angle >= std::numbers::pi || alike >= a.cosine * b.cosine + a.sine * b.sine) return a;
    const glm::dvec3 across = glm::cross(a.axis, b.axis);
    const double sine = glm::length(across), between = std::atan2(sine, alike);
    if (between + b.angle <= a.angle) return a;
    const double angle = 0.5 * (a.angle + between + b.angle);
    if (angle >= std::numbers::pi || !(sine > 0)) return {};
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
        const double o = cone.angle, w = std::min(o + emission, std::numbers::pi);
        const double directions =
            2 * std::numbers::pi * (1 - cone.cosine) +
            0.5 * std::numbers::pi * (2 * w * cone.sine - std::cos(o - 2 * w) - 2 * o * cone.sine + cone.cosine);
        const glm::dvec3 diagonal = bounds.max - bounds.min;
        return intensity * directions * glm::dot(diagonal, diagonal);
    }
};

struct Item {
    Cluster cluster;
    glm::vec3 center;
    uint32_t light;
};

/// A corner of bounds in steps of its parent's size, in the direction of `towards`: -1 down, 1 up.
uint32_t packedCorner(const glm::vec3& corner, const glm::vec3& low, const glm::vec3& size, int towards) {
    uint32_t packed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto steps = int(LIGHT_TREE_BOUNDS_STEPS);
        int step = size[axis] > 0 ? int(std::lround((corner[axis] - low[axis]) / size[axis] * float(steps))) : 0;
        step = std::clamp(step, 0, steps);
        const auto isOutside = [&] {
            const uint32_t at = uint32_t(step) << (10 * axis);
            const float decoded = gpu::lightTreeCorner(at, low, size)[axis];
            return towards < 0 ? decoded <= corner[axis] : decoded >= corner[axis];
        };
        while (!isOutside() && step + towards >= 0 && step + towards <= steps) step += towards;
        packed |= uint32_t(step) << (10 * axis);
    }
    return packed;
}

uint32_t packedAxis(const glm::dvec3& axis) {
    const double sum = std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z);
    glm::dvec2 p = glm::dvec2(axis) / sum;
    if (axis.z < 0) p = {(1 - std::abs(p.y)) * (p.x >= 0 ? 1 : -1), (1 - std::abs(p.x)) * (p.y >= 0 ? 1 : -1)};
    const auto packed = [](double v) { return uint32_t(std::lround((v + 1) * double(LIGHT_TREE_AXIS_STEPS))); };
    return packed(p.x) | packed(p.y) << 16;
}

/// `emission` of a node. The cone may grow by rounding, never shrink, and intensity is never 0.
uint32_t packedEmission(const Cluster& all, double ofParent) {
    const auto cosO = uint32_t(0.5 * (all.cone.cosine + 1) * double(LIGHT_TREE_COS_ORIENTATION_STEPS) + 1e-6);
    const auto cosEmission =
        uint32_t(std::max(std::cos(all.emission), 0.0) * double(LIGHT_TREE_COS_EMISSION_STEPS) + 1e-6);
    const double steps = all.intensity / ofParent * double(LIGHT_TREE_INTENSITY_STEPS);
    const auto intensity = uint32_t(std::clamp(std::round(steps), 1.0, double(LIGHT_TREE_INTENSITY_STEPS)));
    return intensity | cosO << LIGHT_TREE_COS_ORIENTATION_SHIFT | cosEmission << LIGHT_TREE_COS_EMISSION_SHIFT |
           (all.doubleSided ? LIGHT_TREE_DOUBLE_SIDED : 0u);
}

/// Builds a binary tree from the top, of which several levels become one.
class Builder {
 public:
    Builder(std::span<const BoundedLight> lights, std::vector<gpu::LightTreeNode>& nodes, std::vector<uint32_t>& leaves)
        : lights_(lights), nodes_(nodes), leaves_(leaves) {
        for (uint32_t i = 0; i < lights.size(); ++i)
            items_.push_back({Cluster::of(lights[i]), 0.5f * (lights[i].bounds.min + lights[i].bounds.max), i});
    }

    /// @param split First light of the root's second child; 0: where it costs least.
    void build(size_t split) {
        const Range all{0, items_.size()};
        const Cluster ofAll = cluster(all);
        nodes_.push_back(node(ofAll, ofAll, 0));
        if (split > 0)
            addChildren(0, {{all.first, split}, {split, all.last}});
        else
            fill(0, all);
    }

 private:
    static constexpr size_t kBuckets = 12;

    struct Range {
        size_t first, last;  ///< Of items; [first, last).
        size_t count() const { return last - first; }
    };

    Cluster cluster(const Range& range) const {
        Cluster all;
        for (size_t i = range.first; i < range.last; ++i) all.add(items_[i].cluster);
        return all;
    }

    static gpu::LightTreeNode node(const Cluster& all, const Cluster& above, uint32_t parent) {
        const glm::vec3 low = above.bounds.min, size = above.bounds.max - above.bounds.min;
        return {{packedCorner(all.bounds.min, low, size, -1), packedCorner(all.bounds.max, low, size, 1),
                 packedAxis(all.cone.axis), packedEmission(all, above.intensity)},
                0,
                parent,
                all.bounds.min,
                all.bounds.max - all.bounds.min};
    }

    /// Gives node `index` its light or its children.
    void fill(uint32_t index, const Range& range) {
        if (range.count() == 1) {
            const uint32_t light = items_[range.first].light;
            leaves_[light] = index;
            nodes_[index].link = LIGHT_TREE_LEAF | lights_[light].id;
            return;
        }
        const size_t most = range.count() <= LIGHT_TREE_MAX_CHILDREN ? range.count() : LIGHT_TREE_ARITY;
        std::vector<Range> parts{range};
        std::vector<double> costs{0};
        while (parts.size() < most) {
            // Split where the most is to gain
            size_t worst = parts.size();
            for (size_t i = 0; i < parts.size(); ++i)
                if (parts[i].count() > 1 && (worst == parts.size() || costs[i] > costs[worst])) worst = i;
            const size_t middle = partition(parts[worst].first, parts[worst].last);
            const Range second{middle, parts[worst].last};
            parts[worst].last = middle;
            costs[worst] = cluster(parts[worst]).cost();
            parts.insert(parts.begin() + ptrdiff_t(worst) + 1, second);
            costs.insert(costs.begin() + ptrdiff_t(worst) + 1, cluster(second).cost());
        }
        addChildren(index, parts);
    }

    void addChildren(uint32_t index, const std::vector<Range>& parts) {
        const auto first = uint32_t(nodes_.size());
        if (first + parts.size() > LIGHT_TREE_FIRST_CHILD)
            throw Error("light tree: {} lights are too many; leave out some emissive triangles", lights_.size());
        nodes_[index].link = uint32_t(parts.size()) << LIGHT_TREE_COUNT_SHIFT | first;
        const Cluster all = cluster({parts.front().first, parts.back().last});
        for (const Range& part : parts) nodes_.push_back(node(cluster(part), all, index));
        for (size_t i = 0; i < parts.size(); ++i) fill(first + uint32_t(i), parts[i]);
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
        // As lights that face all directions
        bounded.cosOrientation = -1;
        bounded.intensity /= double(LIGHT_TREE_MEAN_COSINE);
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
    Builder(lights, nodes_, leaves_).build(firstGroup < lights.size() ? firstGroup : 0);
    for (const gpu::LightTreeNode& node : nodes_) {
        const gpu::LightTreeNode& parent = nodes_[node.parent];
        bounds_.push_back(gpu::lightTreeBounds(node.summary, parent.low, parent.size));
    }
}

LightTree::Children LightTree::children(uint32_t node) const {
    const uint32_t link = nodes_[node].link;
    if (isLeaf(node)) return {node, 1};
    return {link & LIGHT_TREE_FIRST_CHILD, link >> LIGHT_TREE_COUNT_SHIFT};
}

float LightTree::importance(uint32_t node, const Receiver& to) const {
    const gpu::LightTreeBounds& bounds = bounds_[node];
    if (!lightTreeIsNear(bounds, to.position) || isLeaf(node))
        return lightTreeImportance(bounds, to.position, to.normal);
    const Children below = children(node);
    float sum = 0.0f;
    for (uint32_t k = 0; k < below.count; ++k)
        sum += lightTreeImportance(bounds_[below.first + k], to.position, to.normal);
    return bounds.intensity * sum;
}

float LightTree::childrenImportance(uint32_t node, const Receiver& to) const {
    const Children all = children(node);
    float sum = 0.0f;
    for (uint32_t k = 0; k < all.count; ++k) sum += importance(all.first + k, to);
    return sum;
}

float LightTree::irradiance(const glm::vec3& position, const glm::vec3& normal) const {
    return empty() ? 0.0f : float(intensity_) * childrenImportance(0, {position, normal});
}

LightTree::Pick LightTree::pick(const Receiver& to, float u) const {
    if (empty()) return {kBeside, to.beside > 0.0f ? 1.0f : 0.0f, u};
    float probability = 1.0f, ofBeside = beside(to);
    uint32_t node = 0;
    if (isLeaf(node) && !(ofBeside > 0.0f)) return {nodes_[node].link & ~LIGHT_TREE_LEAF, 1.0f, u};
    do {
        const Children all = children(node);
        std::array<float, LIGHT_TREE_MAX_CHILDREN> weights;
        float total = ofBeside;
        for (uint32_t k = 0; k < all.count; ++k) total += weights[k] = importance(all.first + k, to);
        if (!(total > 0.0f)) return {};
        float rest = u * total, ofPicked = ofBeside;
        uint32_t picked = all.count;
        for (uint32_t k = 0; k < all.count && rest >= ofPicked; ++k) {
            if (!(weights[k] > 0.0f)) continue;
            rest -= ofPicked;
            ofPicked = weights[k];
            picked = k;
        }
        u = std::min(rest / ofPicked, kBelowOne);
        probability *= ofPicked / total;
        if (picked == all.count) return {kBeside, probability, u};
        ofBeside = 0.0f;
        node = all.first + picked;
    } while (!isLeaf(node));
    return {nodes_[node].link & ~LIGHT_TREE_LEAF, probability, u};
}

float LightTree::probability(uint32_t leaf, const Receiver& to) const {
    if (leaf == 0 && !(to.beside > 0.0f)) return 1.0f;
    float probability = 1.0f;
    uint32_t node = leaf;
    do {
        const uint32_t parent = nodes_[node].parent;
        const Children all = children(parent);
        float total = parent == 0 ? beside(to) : 0.0f, ofNode = 0.0f;
        for (uint32_t k = 0; k < all.count; ++k) {
            const float weight = importance(all.first + k, to);
            total += weight;
            if (all.first + k == node) ofNode = weight;
        }
        if (!(total > 0.0f)) return 0.0f;
        probability *= ofNode / total;
        node = parent;
    } while (node != 0);
    return probability;
}

float LightTree::besideProbability(const Receiver& to) const {
    if (!(to.beside > 0.0f)) return 0.0f;
    return empty() ? 1.0f : beside(to) / (beside(to) + childrenImportance(0, to));
}

}  // namespace voxray

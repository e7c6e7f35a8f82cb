#include "scene/light_tree_builder.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/error.h"
#include "scene/light_cluster.h"

namespace voxray {
namespace {

struct Item {
    LightCluster cluster;
    glm::vec3 center;
    uint32_t light;
};

/// Builds a binary tree from the top, of which several levels become one.
class Builder {
 public:
    Builder(std::span<const BoundedLight> lights, std::vector<gpu::LightTreeNode>& nodes, std::vector<uint32_t>& leaves)
        : lights_(lights), nodes_(nodes), leaves_(leaves) {
        for (uint32_t i = 0; i < lights.size(); ++i)
            items_.push_back({LightCluster::of(lights[i]), 0.5f * (lights[i].bounds.min + lights[i].bounds.max), i});
    }

    /// @param split First light of the root's second child; 0: where it costs least.
    void build(size_t split) {
        const Range all{0, items_.size()};
        const LightCluster ofAll = cluster(all);
        nodes_.push_back(node(ofAll, ofAll, 0));
        if (split > 0)
            addChildren(0, {{all.first, split}, {split, all.last}});
        else
            fill(0, all);
    }

 private:
    static constexpr size_t kBuckets = 12;
    /// Lights of a node above single lights, on average: these are weighed one by one, so more of them mean less noise.
    static constexpr size_t kListed = 8;

    struct Range {
        size_t first, last;  ///< Of items; [first, last).
        size_t count() const { return last - first; }
    };

    LightCluster cluster(const Range& range) const {
        LightCluster all;
        for (size_t i = range.first; i < range.last; ++i) all.add(items_[i].cluster);
        return all;
    }

    static gpu::LightTreeNode node(const LightCluster& all, const LightCluster& above, uint32_t parent) {
        return {summaryOf(all, above), 0, parent, all.bounds.min, all.bounds.max - all.bounds.min};
    }

    /// Gives node `index` its light or its children.
    void fill(uint32_t index, const Range& range) {
        if (range.count() == 1) {
            const uint32_t light = items_[range.first].light;
            leaves_[light] = index;
            nodes_[index].link = LIGHT_TREE_LEAF | lights_[light].id;
            return;
        }
        const size_t most = range.count() <= LIGHT_TREE_MAX_CHILDREN
                                ? range.count()
                                : std::min((range.count() + kListed - 1) / kListed, size_t(LIGHT_TREE_MAX_CHILDREN));
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
        const LightCluster all = cluster({parts.front().first, parts.back().last});
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
            std::array<LightCluster, kBuckets> buckets;
            for (size_t i = first; i < last; ++i)
                buckets[bucketOf(centers, axis, items_[i].center)].add(items_[i].cluster);
            std::array<double, kBuckets> above{};
            LightCluster sum;
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

LightTreeNodes buildLightTree(std::span<const BoundedLight> lights, size_t firstGroup) {
    LightTreeNodes built{{}, std::vector<uint32_t>(lights.size())};
    if (!lights.empty()) Builder(lights, built.nodes, built.leaves).build(firstGroup < lights.size() ? firstGroup : 0);
    return built;
}

}  // namespace voxray

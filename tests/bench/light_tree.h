#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <queue>
#include <random>
#include <vector>

namespace voxray {

struct LightPoint {
    glm::vec3 position, normal;
    double flux;  ///< W.
};

/// A binary tree over points of light, cut for each receiver where the error of a node's representative is at
/// most a part of all that arrives (Walter et al. 2005, "Lightcuts").
class LightTree {
 public:
    LightTree(std::vector<LightPoint> points, std::mt19937& random) : points_(std::move(points)) {
        build(0, points_.size(), random);
    }

    /// @param scene tells what arrives from a point, and whether it is seen. @param maxNodes of a cut.
    /// @param part of the sum that a node may be off.
    template <typename Scene>
    double irradiance(const Scene& scene, const LightPoint& texel, size_t maxNodes, double part) const {
        struct Entry {
            double error, brings;
            size_t node;
            bool operator<(const Entry& other) const { return error < other.error; }
        };
        double sum = 0;
        std::priority_queue<Entry> cut;
        const auto add = [&](size_t node) {
            const Node& n = nodes_[node];
            LightPoint stands = points_[n.representative];
            stands.flux = n.flux;
            double brings = scene.arriving(texel, stands, scene.bound());
            if (brings > 0 && !scene.sees(texel, stands)) brings = 0;
            sum += brings;
            cut.push({n.isLeaf ? 0 : bound(n, texel, scene.bound()), brings, node});
        };
        add(nodes_.size() - 1);
        while (cut.size() < maxNodes && cut.top().error > part * sum) {
            const Entry worst = cut.top();
            cut.pop();
            sum -= worst.brings;
            add(nodes_[worst.node].first);
            add(nodes_[worst.node].second);
        }
        return sum;
    }

 private:
    struct Node {
        glm::vec3 low, high;
        double flux;
        size_t representative, first, second;
        bool isLeaf;
    };

    /// What a node's points bring at most, by the distance to its box and the texel's side of it.
    static double bound(const Node& n, const LightPoint& texel, double minSquared) {
        const glm::vec3 nearest = glm::clamp(texel.position, n.low, n.high);
        const glm::vec3 farthest = glm::mix(n.low, n.high, glm::greaterThan(texel.normal, glm::vec3(0)));
        if (glm::dot(farthest - texel.position, texel.normal) <= 0) return 0;
        const glm::dvec3 way = nearest - texel.position;
        return n.flux / (3.14159265358979 * std::max(glm::dot(way, way), minSquared));
    }

    /// Representatives are one child's, by flux: so the tree's sum is right on average.
    size_t build(size_t begin, size_t end, std::mt19937& random) {
        Node n{points_[begin].position, points_[begin].position, points_[begin].flux, begin, 0, 0, end - begin == 1};
        for (size_t i = begin; i < end; ++i) {
            n.low = glm::min(n.low, points_[i].position);
            n.high = glm::max(n.high, points_[i].position);
        }
        if (!n.isLeaf) {
            const glm::vec3 extent = n.high - n.low;
            const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
            const size_t half = (begin + end) / 2;
            const auto at = [&](size_t i) { return points_.begin() + std::ptrdiff_t(i); };
            std::nth_element(at(begin), at(half), at(end), [axis](const LightPoint& a, const LightPoint& b) {
                return a.position[axis] < b.position[axis];
            });
            n.first = build(begin, half, random);
            n.second = build(half, end, random);
            const Node &a = nodes_[n.first], &b = nodes_[n.second];
            n.flux = a.flux + b.flux;
            const double u = std::uniform_real_distribution<double>()(random);
            n.representative = (u * n.flux < a.flux ? a : b).representative;
        }
        nodes_.push_back(n);
        return nodes_.size() - 1;
    }

    std::vector<LightPoint> points_;
    std::vector<Node> nodes_;
};

}  // namespace voxray

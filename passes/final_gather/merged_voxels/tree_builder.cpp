#include "passes/final_gather/merged_voxels/tree_builder.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "base/error.h"
#include "passes/final_gather/merged_voxels/irradiance_tree_types.h"

namespace voxray {
namespace {

/// Relative variance below which irradiances are equal, as packing rounds to 13 bits.
constexpr double kEqual = 1e-9;

/// Squared error per area of black samples in a leaf with others: keeps light from leaking into a black room
/// behind a wall. Prevents such leaves where the area is 1e-6 voxel faces or more.
constexpr double kMixedPenalty = 1e9;

/// Fraction of the samples' extent at either end in which splits are penalized.
constexpr double kPenalizedEnd = 0.25;

/// Sums over samples that yield the error of their mean.
struct Sums {
    uint32_t count = 0;
    double area = 0, litArea = 0, darkArea = 0;
    glm::dvec3 flux{0.0};      ///< Irradiance times area.
    double weight = 0;         ///< Area over the squared error scale.
    glm::dvec3 weighted{0.0};  ///< Irradiance times weight.
    double squared = 0;        ///< Squared irradiance times weight.

    void add(const FaceSample& s) {
        const double w = s.area / (3 * s.errorScale * s.errorScale);
        ++count;
        area += s.area;
        (s.irradiance == glm::dvec3(0.0) ? darkArea : litArea) += s.area;
        flux += s.area * s.irradiance;
        weight += w;
        weighted += w * s.irradiance;
        squared += w * glm::dot(s.irradiance, s.irradiance);
    }
    void add(const Sums& s) {
        count += s.count;
        area += s.area;
        litArea += s.litArea;
        darkArea += s.darkArea;
        flux += s.flux;
        weight += s.weight;
        weighted += s.weighted;
        squared += s.squared;
    }
    glm::dvec3 mean() const { return area > 0 ? flux / area : glm::dvec3(0.0); }
    /// Squared relative error of the mean, summed over samples and averaged over red, green and blue.
    double squaredError() const {
        const glm::dvec3 m = mean();
        const double variance = squared - 2 * glm::dot(weighted, m) + weight * glm::dot(m, m);
        return std::max(variance, 0.0) + kMixedPenalty * std::min(litArea, darkArea);
    }
    bool isUniform() const { return squaredError() <= kEqual * squared; }
    gpu::TreeLeaf leaf() const { return {glm::vec3(mean()), count > 0 ? float(area / count) : 0.0f}; }
};

struct Split {
    int axis = -1;
    int plane = 0;  ///< First voxel behind the plane.
};

/// Costs of a subtree.
struct Subtree {
    double squaredError;
    uint32_t leaves;
};

class Builder {
 public:
    Builder(double tolerance, std::vector<uint32_t>& words) : leafCost_(tolerance * tolerance), words_(words) {}

    Subtree build(std::span<FaceSample> samples) {
        Sums sums;
        glm::ivec3 low(std::numeric_limits<int>::max()), high(std::numeric_limits<int>::min());
        for (const FaceSample& s : samples) {
            sums.add(s);
            low = glm::min(low, s.voxel);
            high = glm::max(high, s.voxel);
        }
        // Leave samples undivided where no split can reduce the cost
        const Subtree asLeaf{sums.squaredError(), 1};
        const size_t first = words_.size();
        const Split split = sums.isUniform() || asLeaf.squaredError < leafCost_
                                ? Split{}
                                : bestSplit(samples, asLeaf.squaredError, low, high);
        if (split.axis < 0) return replaceByLeaf(first, sums, asLeaf);

        // Build both children, and prune them where their leaves reduce the error too little
        const auto behind = std::partition(samples.begin(), samples.end(),
                                           [&](const FaceSample& s) { return s.voxel[split.axis] < split.plane; });
        words_.push_back(0);
        const Subtree before = build({samples.begin(), behind});
        const size_t offset = words_.size() - first;
        const Subtree after = build({behind, samples.end()});
        const Subtree both{before.squaredError + after.squaredError, before.leaves + after.leaves};
        if (cost(both) >= cost(asLeaf)) return replaceByLeaf(first, sums, asLeaf);
        if (offset > TREE_MAX_OFFSET)
            throw Error("merged voxels need a tree of over {} leaves; raise merge_voxels' 'tolerance'", before.leaves);
        words_[first] = gpu::packSplit(uint32_t(split.axis), uint32_t(split.plane), uint32_t(offset));
        return both;
    }

 private:
    double cost(const Subtree& t) const { return t.squaredError + leafCost_ * t.leaves; }

    /// Replaces all words from `first` on by a leaf.
    Subtree replaceByLeaf(size_t first, const Sums& sums, const Subtree& asLeaf) {
        const glm::uvec2 words = gpu::packLeaf(sums.leaf());
        words_.resize(first);
        words_.insert(words_.end(), {words.x, words.y});
        return asLeaf;
    }

    /// The plane between voxels with the least error before and behind it; none for a single voxel. Planes
    /// close to an end are penalized, as cutting off single slices would degenerate the tree to a list.
    /// @param undivided error without a split.
    Split bestSplit(std::span<const FaceSample> samples, double undivided, glm::ivec3 low, glm::ivec3 high) {
        Split best;
        double minError = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const size_t slices = size_t(high[axis] - low[axis]) + 1;
            slices_.assign(slices, {});
            behind_.assign(slices + 1, {});
            for (const FaceSample& s : samples) slices_[size_t(s.voxel[axis] - low[axis])].add(s);
            for (size_t i = slices; i-- > 0;) {
                behind_[i] = behind_[i + 1];
                behind_[i].add(slices_[i]);
            }
            Sums before;
            for (size_t i = 1; i < slices; ++i) {
                before.add(slices_[i - 1]);
                const double fromEnd = double(std::min(i, slices - i)) / double(slices);
                const double error = before.squaredError() + behind_[i].squaredError() +
                                     undivided * std::max(kPenalizedEnd - fromEnd, 0.0);
                if (error >= minError) continue;
                minError = error;
                best = {axis, low[axis] + int(i)};
            }
        }
        return best;
    }

    double leafCost_;
    std::vector<uint32_t>& words_;
    std::vector<Sums> slices_, behind_;
};

}  // namespace

SampleTree buildSampleTree(std::vector<FaceSample>& samples, double tolerance) {
    SampleTree tree;
    const Subtree all = Builder(tolerance, tree.words).build(samples);
    tree.leaves = all.leaves;
    tree.squaredError = all.squaredError;
    return tree;
}

}  // namespace voxray

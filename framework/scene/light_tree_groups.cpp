#include "scene/light_tree_groups.h"

#include <algorithm>
#include <bit>

namespace voxray {

LightTreeGroups::LightTreeGroups(std::span<const gpu::LightTreeNode> nodes) : first_(nodes.size(), kNone) {
    for (uint32_t node = 0; node < nodes.size(); ++node) {
        const uint32_t link = nodes[node].link;
        const bool isLeaf = (link & LIGHT_TREE_LEAF) != 0;
        if (isLeaf && node != 0) continue;
        const uint32_t first = isLeaf ? node : link & LIGHT_TREE_FIRST_CHILD;
        const uint32_t count = isLeaf ? 1 : link >> LIGHT_TREE_COUNT_SHIFT;
        first_[node] = uint32_t(groups_.size());
        for (uint32_t k = 0; k < count; ++k) {
            if (k % kSize == 0) {
                groups_.emplace_back();
                kinds_.emplace_back();
            }
            const auto bounds = lightTreeBounds(nodes[first + k].summary, nodes[node].low, nodes[node].size);
            set(groups_.back(), k % kSize, bounds);
            kinds_.back().facesAll = kinds_.back().facesAll && bounds.cosOrientation <= -1.0f;
        }
        kinds_.back().isLast = true;
    }
    for (uint32_t node = 1; node < nodes.size(); ++node) {
        const uint32_t parent = nodes[node].parent, k = node - (nodes[parent].link & LIGHT_TREE_FIRST_CHILD);
        groups_[first_[parent] + k / kSize].below[k % kSize] = first_[node];
    }
}

void LightTreeGroups::set(Group& group, uint32_t k, const gpu::LightTreeBounds& bounds) {
    for (int i = 0; i < 3; ++i) {
        group.center[size_t(i)][k] = bounds.center[i];
        group.halfSize[size_t(i)][k] = bounds.halfSize[i];
        group.axis[size_t(i)][k] = bounds.axis[i];
    }
    group.intensity[k] = bounds.intensity;
    group.cosOrientation[k] = bounds.cosOrientation;
    group.sinOrientation[k] = bounds.sinOrientation;
    group.cosEmission[k] = bounds.cosEmission;
    group.doubleSided[k] = bounds.doubleSided;
}

template <bool facesAll>
void LightTreeWalk::weigh(const Group& group, Weighed& __restrict weighed) const {
    // Compilers make vector instructions of both loops, as neither branches
    for (uint32_t k = 0; k < kSize; ++k) {
        gpu::LightTreeBounds b;
        b.center = {group.center[0][k], group.center[1][k], group.center[2][k]};
        b.halfSize = {group.halfSize[0][k], group.halfSize[1][k], group.halfSize[2][k]};
        b.axis = {group.axis[0][k], group.axis[1][k], group.axis[2][k]};
        b.intensity = group.intensity[k];
        b.cosOrientation = facesAll ? -1.0f : group.cosOrientation[k];
        b.sinOrientation = group.sinOrientation[k];
        b.cosEmission = group.cosEmission[k];
        b.doubleSided = group.doubleSided[k];
        weighed.importance[k] = lightTreeImportance(b, position_, normal_);
    }
    for (uint32_t k = 0; k < kSize; ++k) {
        gpu::LightTreeBounds b;
        b.center = {group.center[0][k], group.center[1][k], group.center[2][k]};
        b.halfSize = {group.halfSize[0][k], group.halfSize[1][k], group.halfSize[2][k]};
        weighed.isNear[k] = (group.below[k] != kNone) & lightTreeIsNear(b, position_) ? 1u : 0u;
    }
}

float LightTreeWalk::weigh(uint32_t group, Children& children) const {
    children.group = group;
    children.count = 0;
    float sum = 0.0f;
    for (bool isLast = false; !isLast; ++group) {
        Weighed& weighed = children.of[children.count++];
        if (kinds_[group].facesAll)
            weigh<true>(groups_[group], weighed);
        else
            weigh<false>(groups_[group], weighed);
        for (const float importance : weighed.importance) sum += importance;
        isLast = kinds_[group].isLast;
    }
    return sum;
}

float LightTreeWalk::importances(Importances& of) {
    of.fill(0.0f);
    isNear_ = 0;
    for (uint32_t g = 0; g < here_.count; ++g) {
        const Weighed& weighed = here_.of[g];
        std::copy(weighed.importance.begin(), weighed.importance.end(), of.begin() + g * kSize);
        for (uint32_t k = 0; k < kSize; ++k) isNear_ |= weighed.isNear[k] << (g * kSize + k);
    }
    for (uint32_t rest = isNear_; rest != 0; rest &= rest - 1) {
        const auto child = uint32_t(std::countr_zero(rest));
        const Group& group = groups_[here_.group + child / kSize];
        of[child] = group.intensity[child % kSize] * weigh(group.below[child % kSize], below_[child]);
    }
    float total = 0.0f;
    for (uint32_t child = 0; child < here_.count * kSize; ++child) total += of[child];
    return total;
}

void LightTreeWalk::down(uint32_t child) {
    if ((isNear_ >> child & 1) != 0)
        here_ = below_[child];
    else
        weigh(groups_[here_.group + child / kSize].below[child % kSize], here_);
}

}  // namespace voxray

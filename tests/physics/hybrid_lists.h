#pragma once

#include <vector>

#include "passes/hybrid_leaves/hybrid_types.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray::test {

/// The triangles of each leaf, ascending.
using LeafLists = std::vector<std::vector<uint32_t>>;

/// Of leaves without grids, and without the items that stand before groups (passes/hybrid_leaves/hybrid_types.h).
inline LeafLists listsOf(const std::vector<uint32_t>& words, const std::vector<uint32_t>& items) {
    LeafLists lists(words.size());
    for (size_t leaf = 0; leaf < words.size(); ++leaf) {
        if (words[leaf] == LEAF_EMPTY) continue;
        const bool hasGroups = (words[leaf] & LIST_HAS_GROUPS) != 0;
        const uint32_t* item = &items[size_t(words[leaf] & ~LIST_HAS_GROUPS) * LIST_ITEM_WORDS];
        bool ends = false;
        for (size_t i = 0; !ends; ++i, item += LIST_ITEM_WORDS) {
            if (hasGroups && i % (LIST_GROUP + 1) == 0) continue;
            lists[leaf].push_back(item[1]);
            ends = (item[0] & LIST_ENDS) != 0;
        }
    }
    return lists;
}

/// The number of each voxel's leaf, x fastest; ~0 where none is.
inline std::vector<uint32_t> leafNumbers(const gpu::VoxelGrid& grid, const std::vector<uint32_t>& occupancy) {
    std::vector<uint32_t> numbers;
    uint32_t leaf = 0;
    for (uint32_t row = 0; row < grid.resolution.z * grid.resolution.y; ++row)
        for (uint32_t x = 0; x < grid.resolution.x; ++x)
            numbers.push_back(occupancy[row * grid.wordsPerRow + x / 32] >> (x % 32) & 1u ? leaf++ : ~0u);
    return numbers;
}

}  // namespace voxray::test

#include "passes/common/octree/octree.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

/// The buffer `octree` of shaders/octree/octree.glsl.
struct OctreeHeader {
    VkDeviceAddress table, nodes;
    gpu::OctreeShape shape;
};

/// Words of the table at a level, border included.
uint64_t tableWords(glm::uvec3 resolution, uint32_t level) {
    const glm::u64vec3 size(levelResolution(resolution, level) + 2u);
    return size.x * size.y * size.z;
}

/// The first index of each level of the table, and the end of the last.
std::vector<uint64_t> tableOffsets(const OctreeSize& size) {
    std::vector<uint64_t> offsets{0};
    for (uint32_t level = size.tableLevel(); level <= size.levels(); ++level)
        offsets.push_back(offsets.back() + tableWords(size.resolution, level));
    return offsets;
}

}  // namespace

std::vector<uint32_t> OctreeSize::first() const {
    std::vector<uint32_t> result(nodes.size(), 1);
    for (size_t level = nodes.size() - 1; level-- > 0;) result[level] = result[level + 1] + nodes[level + 1];
    return result;
}

uint32_t OctreeSize::tableLevel() const {
    for (uint32_t level = 1; level < levels(); ++level)
        if (tableWords(resolution, level) <= 2ull * nodes.front()) return level;
    return levels();
}

uint64_t OctreeSize::tableBytes() const {
    return tableOffsets(*this).back() * sizeof(uint32_t);
}
uint64_t OctreeSize::nodeBytes() const {
    return uint64_t(first().front()) * sizeof(uint32_t);
}

Octree allocateOctree(CommandStream& stream, const OctreeSize& size) {
    if (size.levels() > OCTREE_MAX_LEVELS)
        throw Error("an octree takes at most {} voxels along an axis; the grid has {}x{}x{}",
                    1u << (OCTREE_MAX_LEVELS - 1), size.resolution.x, size.resolution.y, size.resolution.z);
    if (size.nodeCount() > OCTREE_MAX_NODES)
        throw Error("an octree takes at most {} nodes; this one needs {}: lower voxelize's 'resolution'",
                    OCTREE_MAX_NODES, size.nodeCount());
    Device& device = stream.device();
    Octree octree;
    octree.size = size;
    octree.table = Buffer(device, "octree table", size.tableBytes());
    octree.nodes = Buffer(device, "octree nodes", size.nodeBytes());
    octree.header = Buffer(device, "octree header", sizeof(OctreeHeader));

    OctreeHeader header{octree.table.address(),
                        octree.nodes.address(),
                        {size.resolution, size.levels(), size.nodeCount(), size.tableLevel(), {}}};
    const std::vector<uint64_t> offsets = tableOffsets(size);
    std::copy(offsets.begin(), offsets.end() - 1, header.shape.tableFirst);
    stream.upload(octree.header, std::as_bytes(std::span(&header, 1)));

    // NO_NODE has no children. The table ends with the 3x3x3 entries of the level above the root: the root is the child
    // in octant 0 of the center
    const uint32_t none = 0, aboveRoot = 1u << 8 | 1u;
    const auto write = [&](const Buffer& target, uint32_t word, uint64_t index) {
        stream.upload(target, std::as_bytes(std::span(&word, 1)), index * sizeof(word));
    };
    stream.fill(octree.table, 0);
    write(octree.table, aboveRoot, offsets.back() - 14);
    write(octree.nodes, none, 0);
    return octree;
}

}  // namespace voxray

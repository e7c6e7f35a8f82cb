#include "passes/filter_voxels/octree.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

/// The block RadianceOctree of shaders/octree.glsl.
struct Header {
    gpu::OctreeShape shape;
    VkDeviceAddress table, nodes, values;
};
static_assert(offsetof(Header, table) == sizeof(gpu::OctreeShape), "addresses follow without a gap");

/// Where the table of each level from the table's on up begins, and its end.
std::vector<uint32_t> tableOffsets(const OctreeSize& size) {
    std::vector<uint32_t> offsets{0};
    for (uint32_t level = size.tableLevel(); level <= size.levels(); ++level) {
        const glm::uvec3 cells = octreeCells(size.resolution, level);
        offsets.push_back(offsets.back() + cells.x * cells.y * cells.z);
    }
    return offsets;
}

}  // namespace

uint32_t octreeLevels(glm::uvec3 resolution) {
    const uint32_t longest = std::max({resolution.x, resolution.y, resolution.z});
    uint32_t levels = 1;
    while ((1u << levels) < longest) ++levels;
    return levels;
}

std::vector<uint32_t> OctreeSize::first() const {
    std::vector<uint32_t> result(nodes.size(), 0);
    for (size_t level = nodes.size() - 1; level-- > 0;)
        result[level] = (result[level + 1] + nodes[level + 1] + 3) / 4 * 4;
    return result;
}

uint32_t OctreeSize::tableLevel() const {
    for (uint32_t level = 1; level < levels(); ++level) {
        const glm::uvec3 cells = octreeCells(resolution, level);
        if (2ull * cells.x * cells.y * cells.z <= nodes.front()) return level;
    }
    return levels();
}

uint64_t OctreeSize::tableBytes() const {
    return uint64_t(tableOffsets(*this).back()) * sizeof(uint32_t);
}
uint64_t OctreeSize::nodeBytes() const {
    return uint64_t(first().front()) / 4 * sizeof(glm::uvec2);
}
uint64_t OctreeSize::valueBytes() const {
    return uint64_t(nodeCount()) * directions * sizeof(glm::uvec2);
}
uint64_t OctreeSize::bytes() const {
    return sizeof(Header) + tableBytes() + nodeBytes() + valueBytes();
}

RadianceOctree::RadianceOctree(CommandStream& stream, const gpu::VoxelGrid& voxelGrid, OctreeSize counted)
    : grid(voxelGrid), size(std::move(counted)), first(size.first()) {
    if (size.nodes.size() > OCTREE_MOST_LEVELS)
        throw Error("the octree takes at most {} voxels along a side; the grid has {}x{}x{}",
                    1u << (OCTREE_MOST_LEVELS - 1), size.resolution.x, size.resolution.y, size.resolution.z);
    Device& device = stream.device();
    header = Buffer(device, "octree header", sizeof(Header));
    table = Buffer(device, "octree table", size.tableBytes());
    nodes = Buffer(device, "octree nodes", size.nodeBytes());
    values = Buffer(device, "octree values", size.valueBytes());

    Header block{};
    block.shape = {grid.origin,       grid.voxelSize,   size.resolution, size.levels(),
                   size.tableLevel(), size.nodeCount(), size.directions, {}};
    const std::vector<uint32_t> offsets = tableOffsets(size);
    std::copy(offsets.begin(), offsets.end() - 1, block.shape.tableFirst);
    block.table = table.address();
    block.nodes = nodes.address();
    block.values = values.address();
    stream.upload(header, std::as_bytes(std::span(&block, 1)));

    // The root is number 0, and the table's last entry.
    stream.fill(table, NO_NODE);
    const uint32_t root = 0;
    stream.upload(table, std::as_bytes(std::span(&root, 1)), table.bytes() - sizeof(root));
}

}  // namespace voxray

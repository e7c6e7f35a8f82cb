#include "passes/common/octree/octree.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of shaders/octree/octree.glsl.
struct Header {
    gpu::RadianceGrid grid;
    VkDeviceAddress table, nodes, values;
    gpu::OctreeShape shape;
};
static_assert(sizeof(gpu::RadianceGrid) % sizeof(VkDeviceAddress) == 0);

/// Words of the table at a level, border included.
uint64_t tableWords(glm::uvec3 resolution, uint32_t level) {
    const glm::u64vec3 size(radianceResolution(resolution, level) + 2u);
    return size.x * size.y * size.z;
}

/// Where the table of each level from the table's on up begins, and its end.
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
uint64_t OctreeSize::valueBytes() const {
    return uint64_t(nodeCount()) * directions * sizeof(glm::uvec2);
}
uint64_t OctreeSize::bytes() const {
    return sizeof(Header) + tableBytes() + nodeBytes() + valueBytes();
}

void allocateOctree(CommandStream& stream, const OctreeSize& size, RadianceVoxels& radiance) {
    if (size.levels() > OCTREE_MAX_LEVELS)
        throw Error("an octree takes at most {} voxels along an axis; the grid has {}x{}x{}",
                    1u << (OCTREE_MAX_LEVELS - 1), size.resolution.x, size.resolution.y, size.resolution.z);
    if (size.nodeCount() > OCTREE_MAX_NODES)
        throw Error("an octree takes at most {} nodes; this one needs {}: lower voxelize's 'resolution'",
                    OCTREE_MAX_NODES, size.nodeCount());
    Device& device = stream.device();
    radiance.storage.clear();
    radiance.storage.emplace_back(device, "octree table", size.tableBytes());
    radiance.storage.emplace_back(device, "octree nodes", size.nodeBytes());
    radiance.storage.emplace_back(device, "octree values", size.valueBytes());
    radiance.header = Buffer(device, "octree header", sizeof(Header));

    Header header{radiance.grid,
                  radiance.storage[kOctreeTable].address(),
                  radiance.storage[kOctreeNodes].address(),
                  radiance.storage[kOctreeValues].address(),
                  {size.nodeCount(), size.tableLevel(), {}}};
    const std::vector<uint64_t> offsets = tableOffsets(size);
    std::copy(offsets.begin(), offsets.end() - 1, header.shape.tableFirst);
    stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));

    // Number 0 is no node; the root is octant 0 of the table's last level.
    const uint32_t none = 0, aboveRoot = 1u << 8 | 1u;
    const glm::uvec2 nothing(0);
    const auto write = [&](OctreeStorage target, const auto& value, uint64_t index) {
        stream.upload(radiance.storage[target], std::as_bytes(std::span(&value, 1)), index * sizeof(value));
    };
    stream.fill(radiance.storage[kOctreeTable], 0);
    write(kOctreeTable, aboveRoot, offsets.back() - 14);  // The center of 3x3x3.
    write(kOctreeNodes, none, 0);
    for (uint64_t face = 0; face < size.directions; ++face)
        write(kOctreeValues, nothing, face * size.nodeCount());
}

}  // namespace voxray

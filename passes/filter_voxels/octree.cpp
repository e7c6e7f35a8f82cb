#include "passes/filter_voxels/octree.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of shaders/octree.glsl.
struct Header {
    gpu::RadianceGrid grid;
    VkDeviceAddress table, nodes, values;
    gpu::OctreeShape shape;
};
static_assert(sizeof(gpu::RadianceGrid) % sizeof(VkDeviceAddress) == 0);

/// Where the table of each level from the table's on up begins, and its end.
std::vector<uint32_t> tableOffsets(const OctreeSize& size) {
    std::vector<uint32_t> offsets{0};
    for (uint32_t level = size.tableLevel(); level < size.levels(); ++level) {
        const glm::uvec3 voxels = radianceResolution(size.resolution, level);
        offsets.push_back(offsets.back() + voxels.x * voxels.y * voxels.z);
    }
    return offsets;
}

}  // namespace

std::vector<uint32_t> OctreeSize::first() const {
    std::vector<uint32_t> result(nodes.size(), 0);
    for (size_t level = nodes.size() - 1; level-- > 0;)
        result[level] = (result[level + 1] + nodes[level + 1] + 3) / 4 * 4;
    return result;
}

uint32_t OctreeSize::tableLevel() const {
    for (uint32_t level = 1; level + 1 < levels(); ++level) {
        const glm::uvec3 voxels = radianceResolution(resolution, level);
        if (2ull * voxels.x * voxels.y * voxels.z <= nodes.front()) return level;
    }
    return levels() - 1;
}

uint64_t OctreeSize::tableBytes() const {
    return uint64_t(tableOffsets(*this).back()) * sizeof(uint32_t);
}
uint64_t OctreeSize::nodeBytes() const {
    return std::max<uint64_t>(first().front() / 4, 1) * sizeof(glm::uvec2);
}
uint64_t OctreeSize::valueBytes() const {
    return uint64_t(nodeCount()) * directions * sizeof(glm::uvec2);
}
uint64_t OctreeSize::bytes() const {
    return sizeof(Header) + tableBytes() + nodeBytes() + valueBytes();
}

void allocateOctree(CommandStream& stream, const OctreeSize& size, RadianceVoxels& radiance) {
    if (size.levels() > OCTREE_MOST_LEVELS)
        throw Error("an octree takes at most {} voxels along an axis; the grid has {}x{}x{}",
                    1u << (OCTREE_MOST_LEVELS - 1), size.resolution.x, size.resolution.y, size.resolution.z);
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
    const std::vector<uint32_t> offsets = tableOffsets(size);
    std::copy(offsets.begin(), offsets.end() - 1, header.shape.tableFirst);
    stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));

    // The root is number 0, and the table's last entry.
    const Buffer& table = radiance.storage[kOctreeTable];
    const uint32_t root = 0;
    stream.fill(table, NO_NODE);
    stream.upload(table, std::as_bytes(std::span(&root, 1)), table.bytes() - sizeof(root));
}

}  // namespace voxray

#include "passes/common/octree/brick_octree_builder.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "passes/common/voxels/grid_levels.h"

namespace voxray {
namespace {

using gpu::BrickNode;
using gpu::LevelNodes;
static_assert(sizeof(BrickNode) == kBrickNodeBytes);
constexpr uint32_t kLongestAxis = 1024;  // Coordinates of nodes have 10 bits.

/// Reallocates the pool for so many nodes if it is too small, and copies the present ones. Where surfaces
/// move an eighth is added, so that the pool isn't reallocated in each frame.
void grow(CommandStream& stream, BrickOctree& octree, uint64_t nodes) {
    if (octree.nodes && octree.nodes.bytes() >= nodes * kBrickNodeBytes) return;
    if (octree.moves) nodes += nodes / 8;
    const uint64_t bytes = nodes * kBrickNodeBytes;
    if (nodes > UINT32_MAX) throw Error("an octree of {} nodes can't be numbered in 32 bits", nodes);
    LargeBuffer larger(stream.device(), "octree nodes", bytes);
    if (octree.nodeCount > 0) stream.copy(octree.nodes, larger, uint64_t(octree.nodeCount) * kBrickNodeBytes);
    stream.finish();
    octree.nodes = std::move(larger);
}

}  // namespace

BrickOctreeBuilder::BrickOctreeBuilder(ProgramOwner& owner, bool neighbors)
    : neighbors_(neighbors ? 1 : 0),
      flag_(owner, "brick_octree_flag.comp"),
      link_(owner, "brick_octree_link.comp"),
      subdivide_(owner, "brick_octree_subdivide.comp"),
      clear_(owner, "brick_octree_clear.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints) {}

void BrickOctreeBuilder::build(CommandStream& stream, BrickOctree& octree, const LargeBuffer& cells,
                               uint32_t fragments) const {
    const glm::uvec3 size = octree.grid.resolution;
    if (std::max({size.x, size.y, size.z}) > kLongestAxis)
        throw Error("an octree of bricks takes at most {} voxels along an axis; the grid has {}x{}x{}", kLongestAxis,
                    size.x, size.y, size.z);
    octree.levels.assign(gridLevels(size), LevelNodes{});
    octree.levels.back().staticCount = 1;
    octree.nodeCount = octree.brickCount = 0;
    grow(stream, octree, 1);
    BrickNode root{};
    root.brick = NO_BRICK;
    stream.upload(octree.nodes, std::as_bytes(std::span(&root, 1)));
    octree.nodeCount = 1;
    addNodes(stream, octree, Section::Static, cells, fragments);
    octree.staticNodes = octree.nodeCount;
    octree.staticBricks = octree.brickCount;
}

void BrickOctreeBuilder::rebuildDynamic(CommandStream& stream, BrickOctree& octree, const LargeBuffer& cells,
                                        uint32_t fragments) const {
    stream.dispatch(clear_, octree.staticNodes,
                    {{"OctreeNodesRef", octree.nodes.ref()},
                     {"staticNodes", octree.staticNodes},
                     {"staticBricks", octree.staticBricks}});
    octree.nodeCount = octree.staticNodes;
    octree.brickCount = octree.staticBricks;
    for (LevelNodes& level : octree.levels) level.dynamicFirst = level.dynamicCount = 0;
    addNodes(stream, octree, Section::Dynamic, cells, fragments);
}

void BrickOctreeBuilder::addNodes(CommandStream& stream, BrickOctree& octree, Section section, const LargeBuffer& cells,
                                  uint32_t fragments) const {
    const uint32_t top = uint32_t(octree.levels.size()) - 1;
    for (uint32_t level = top + 1; level-- > 0;) {
        const LevelNodes nodes = octree.levels[level];
        const uint32_t count = nodesOf(nodes), depth = top - level;
        const auto scratch = [&](const char* name) { return Buffer(stream.device(), name, count * sizeof(uint32_t)); };
        const Buffer visited = scratch("visited nodes"), flags = scratch("flagged nodes"),
                     before = scratch("flags before");
        stream.fill(visited, 0);
        stream.fill(flags, 0);
        stream.dispatch(flag_, fragments,
                        {{"FragmentCellsRef", cells.ref()},
                         {"OctreeNodesRef", octree.nodes.ref()},
                         {"visited", visited},
                         {"flags", flags},
                         {"nodes", nodes},
                         {"resolution", levelResolution(octree.grid.resolution, level)},
                         {"level", level},
                         {"depth", depth},
                         {"fragments", fragments},
                         {"neighbors", neighbors_}});
        stream.dispatch(link_, count, {{"OctreeNodesRef", octree.nodes.ref()}, {"nodes", nodes}, {"depth", depth}});
        const uint32_t flagged = prefixSum_.run(stream, flags, before, count);
        const uint32_t firstChild = level == 0 ? NO_CHILDREN : octree.nodeCount;
        if (level > 0) {
            grow(stream, octree, octree.nodeCount + 8ull * flagged);
            LevelNodes& finer = octree.levels[level - 1];
            (section == Section::Static ? finer.staticFirst : finer.dynamicFirst) = octree.nodeCount;
            (section == Section::Static ? finer.staticCount : finer.dynamicCount) = 8 * flagged;
            octree.nodeCount += 8 * flagged;
        }
        stream.dispatch(subdivide_, count,
                        {{"OctreeNodesRef", octree.nodes.ref()},
                         {"flags", flags},
                         {"before", before},
                         {"nodes", nodes},
                         {"firstBrick", octree.brickCount},
                         {"firstChild", firstChild}});
        octree.brickCount += flagged;
        stream.finish();
    }
}

}  // namespace voxray

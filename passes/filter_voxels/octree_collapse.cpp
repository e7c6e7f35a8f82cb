#include "passes/filter_voxels/octree_collapse.h"

#include <algorithm>

#include "passes/common/dispatch.h"

namespace voxray {
namespace {

struct UniformPush {
    uint32_t firstNode;
    uint32_t count;
    uint32_t level;
};

struct LevelPush {
    uint32_t count;
    uint32_t firstNode;
    uint32_t firstChild;
    uint32_t childLevel;
};

}  // namespace

OctreeCollapse::OctreeCollapse(Device& device, const ShaderCompiler& compiler)
    : prefixSum_(device, compiler) {
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(device,
                                  compiler.compile(std::string("passes/filter_voxels/") + file, defines));
    };
    uniform_ = program("octree_uniform.comp", {});
    masks_ = program("octree_collapse.comp", {{"MASKS", "1"}});
    children_ = program("octree_collapse.comp", {{"CHILDREN", "1"}});
    table_ = program("octree_collapse_table.comp", {});
}

RadianceOctree OctreeCollapse::run(CommandStream& stream, RadianceOctree octree) const {
    // From the leaves up: which nodes are uniform.
    const uint32_t levels = octree.size.levels();
    const Buffer uniform(stream.device(), "octree uniform nodes",
                         (uint64_t(octree.size.nodeCount()) + 31) / 32 * sizeof(uint32_t));
    const Buffer counts(stream.device(), "octree uniform counts", (levels + 1) * sizeof(uint32_t));
    stream.fill(uniform, 0);
    stream.fill(counts, 0);
    for (uint32_t level = 1; level <= levels; ++level)
        stream.dispatch(uniform_,
                        {{"radianceOctree", octree.header}, {"uniform_", uniform}, {"counts", counts}},
                        UniformPush{octree.first[level], octree.size.nodes[level], level},
                        linearGroups(octree.size.nodes[level]));

    // Each of them drops its eight children.
    const std::vector<uint32_t> uniformNodes = stream.readAs<uint32_t>(counts, levels + 1);
    if (std::ranges::all_of(uniformNodes, [](uint32_t count) { return count == 0; })) return octree;
    OctreeSize size = octree.size;
    for (uint32_t level = 1; level <= levels; ++level) size.nodes[level - 1] -= 8 * uniformNodes[level];
    return shrink(stream, octree, uniform, std::move(size));
}

RadianceOctree OctreeCollapse::shrink(CommandStream& stream, const RadianceOctree& octree,
                                      const Buffer& uniform, OctreeSize smaller) const {
    Device& device = stream.device();
    RadianceOctree result(stream, octree.grid, std::move(smaller));
    for (uint64_t face = 0; face < result.size.directions; ++face)  // The root is number 0 in both.
        stream.copy(octree.values, result.values, sizeof(glm::uvec2),
                    face * octree.size.nodeCount() * sizeof(glm::uvec2),
                    face * result.size.nodeCount() * sizeof(glm::uvec2));

    // From the root down, as it was built.
    Buffer nodes(device, "octree root", sizeof(glm::uvec2));
    stream.fill(nodes, 0);
    for (uint32_t level = result.size.levels(); level > 0 && result.size.nodes[level] > 0; --level) {
        const uint32_t count = result.size.nodes[level], words = (count + 3) / 4;
        const uint32_t childCount = std::max(result.size.nodes[level - 1], 1u);
        const Buffer masks(device, "octree masks", uint64_t(words) * sizeof(uint32_t));
        const Buffer before(device, "octree ranks", uint64_t(words) * sizeof(uint32_t));
        Buffer children(device, "octree children", uint64_t(childCount) * sizeof(glm::uvec2));
        const LevelPush push{count, result.first[level], result.first[level - 1], level - 1};
        stream.dispatch(
            masks_,
            {{"radianceOctree", octree.header}, {"nodes", nodes}, {"uniform_", uniform}, {"masks", masks}},
            push, linearGroups(words));
        prefixSum_.run(stream, masks, before, words);
        stream.dispatch(children_,
                        {{"radianceOctree", octree.header},
                         {"nodes", nodes},
                         {"masks", masks},
                         {"before", before},
                         {"children", children},
                         {"collapsed", result.header}},
                        push, linearGroups(words));
        stream.finish();
        nodes = std::move(children);
    }

    for (uint32_t level = result.size.levels(); level-- > result.size.tableLevel();) {
        const glm::uvec3 cells = octreeCells(result.size.resolution, level);
        stream.dispatch(table_, {{"radianceOctree", result.header}}, level,
                        linearGroups(uint64_t(cells.x) * cells.y * cells.z));
    }
    stream.finish();
    return result;
}

}  // namespace voxray

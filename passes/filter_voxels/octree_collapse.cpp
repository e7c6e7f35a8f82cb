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

OctreeSize OctreeCollapse::run(CommandStream& stream, const OctreeSize& size,
                               RadianceVoxels& radiance) const {
    // From the leaves up: which nodes are uniform.
    const std::vector<uint32_t> first = size.first();
    const Buffer uniform(stream.device(), "octree uniform nodes",
                         (uint64_t(size.nodeCount()) + 31) / 32 * sizeof(uint32_t));
    const Buffer counts(stream.device(), "octree uniform counts", size.levels() * sizeof(uint32_t));
    stream.fill(uniform, 0);
    stream.fill(counts, 0);
    for (uint32_t level = 1; level < size.levels(); ++level)
        stream.dispatch(uniform_,
                        {{"radianceVoxels", radiance.header}, {"uniform_", uniform}, {"counts", counts}},
                        UniformPush{first[level], size.nodes[level], level}, linearGroups(size.nodes[level]));

    // Each of them drops its eight children.
    const std::vector<uint32_t> uniformNodes = stream.readAs<uint32_t>(counts, size.levels());
    OctreeSize smaller = size;
    for (uint32_t level = 1; level < size.levels(); ++level)
        smaller.nodes[level - 1] -= 8 * uniformNodes[level];
    if (smaller.nodes != size.nodes) radiance = shrink(stream, radiance, size, uniform, smaller);
    return smaller;
}

RadianceVoxels OctreeCollapse::shrink(CommandStream& stream, const RadianceVoxels& radiance,
                                      const OctreeSize& size, const Buffer& uniform,
                                      const OctreeSize& smaller) const {
    Device& device = stream.device();
    RadianceVoxels result;
    result.layout = radiance.layout;
    result.grid = radiance.grid;
    allocateOctree(stream, smaller, result);
    for (uint64_t face = 0; face < size.directions; ++face)  // The root is number 0 in both.
        stream.copy(radiance.storage[kOctreeValues], result.storage[kOctreeValues], sizeof(glm::uvec2),
                    face * size.nodeCount() * sizeof(glm::uvec2),
                    face * smaller.nodeCount() * sizeof(glm::uvec2));

    // From the root down, as it was built.
    const std::vector<uint32_t> first = smaller.first();
    Buffer nodes(device, "octree root", sizeof(glm::uvec2));
    stream.fill(nodes, 0);
    for (uint32_t level = smaller.levels() - 1; level > 0 && smaller.nodes[level] > 0; --level) {
        const uint32_t count = smaller.nodes[level], words = (count + 3) / 4;
        const Buffer masks(device, "octree masks", uint64_t(words) * sizeof(uint32_t));
        const Buffer before(device, "octree ranks", uint64_t(words) * sizeof(uint32_t));
        Buffer children(device, "octree children",
                        uint64_t(std::max(smaller.nodes[level - 1], 1u)) * sizeof(glm::uvec2));
        const LevelPush push{count, first[level], first[level - 1], level - 1};
        stream.dispatch(
            masks_,
            {{"radianceVoxels", radiance.header}, {"nodes", nodes}, {"uniform_", uniform}, {"masks", masks}},
            push, linearGroups(words));
        prefixSum_.run(stream, masks, before, words);
        stream.dispatch(children_,
                        {{"radianceVoxels", radiance.header},
                         {"nodes", nodes},
                         {"masks", masks},
                         {"before", before},
                         {"children", children},
                         {"collapsed", result.header}},
                        push, linearGroups(words));
        stream.finish();
        nodes = std::move(children);
    }

    for (uint32_t level = smaller.levels() - 1; level-- > smaller.tableLevel();) {
        const glm::uvec3 voxels = radianceResolution(size.resolution, level);
        stream.dispatch(table_, result.bindings(), level,
                        linearGroups(uint64_t(voxels.x) * voxels.y * voxels.z));
    }
    stream.finish();
    return result;
}

uint64_t OctreeCollapse::scratchBytes(const OctreeSize& size) {
    return (uint64_t(size.nodeCount()) + 31) / 32 * sizeof(uint32_t);
}

}  // namespace voxray

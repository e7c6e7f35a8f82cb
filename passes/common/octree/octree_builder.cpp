#include "passes/common/octree/octree_builder.h"
#include "passes/common/compute/bit_words.h"

#include <utility>

namespace voxray {
namespace {

uint64_t cellWords(glm::uvec3 cells) {
    return bitWords(cells.x) * cells.y * cells.z;
}

}  // namespace

OctreeBuilder::OctreeBuilder(ProgramOwner& owner)
    : flag_(owner, "octree_flag.comp"),
      subdivide_(owner, "octree_subdivide.comp"),
      number_(owner, "octree_number.comp"),
      prefixSum_(owner, PrefixSum::Input::SetBits) {}

Octree OctreeBuilder::build(CommandStream& stream, const SurfaceVoxels& voxels) const {
    Device& device = stream.device();
    OctreeSize size{voxels.grid.resolution, {}};
    const std::vector<Buffer> flags = flag(stream, voxels, size);
    Octree octree = allocateOctree(stream, size);

    // Top-down: masks of children, then their indices and voxels
    const std::vector<uint32_t> first = size.first();
    Buffer cells(device, "octree root", sizeof(uint32_t));
    stream.fill(cells, 0);
    for (uint32_t level = size.levels() - 1; level > 0; --level) {
        const uint32_t count = size.nodes[level], words = (count + 3) / 4;
        const Buffer masks(device, "octree masks", uint64_t(words) * sizeof(uint32_t));
        const Buffer before(device, "octree ranks", uint64_t(words) * sizeof(uint32_t));
        Buffer children(device, "octree cells", uint64_t(size.nodes[level - 1]) * sizeof(uint32_t));
        const Buffer& finer = level == 1 ? voxels.occupancy : flags[level - 2];
        stream.dispatch(subdivide_, words,
                        {{"flags", finer},
                         {"cells", cells},
                         {"masks", masks},
                         {"finerSize", levelResolution(size.resolution, level - 1)},
                         {"count", count}});
        prefixSum_.run(stream, masks, before, words);
        stream.dispatch(number_, words,
                        {octree,
                         {"cells", cells},
                         {"masks", masks},
                         {"before", before},
                         {"childCells", children},
                         {"level", level},
                         {"count", count},
                         {"firstNode", first[level]},
                         {"firstChild", first[level - 1]}});
        stream.finish();
        cells = std::move(children);
    }
    stream.finish();
    octree.leafVoxels = std::move(cells);
    return octree;
}

std::vector<Buffer> OctreeBuilder::flag(CommandStream& stream, const SurfaceVoxels& voxels, OctreeSize& size) const {
    // Bottom-up, each level from the next finer one
    const uint32_t levels = gridLevels(size.resolution);
    const Buffer counts(stream.device(), "octree node counts", levels * sizeof(uint32_t));
    stream.fill(counts, 0);
    std::vector<Buffer> flags;
    for (uint32_t level = 1; level < levels; ++level) {
        const glm::uvec3 coarser = levelResolution(size.resolution, level);
        flags.emplace_back(stream.device(), "octree flags", cellWords(coarser) * sizeof(uint32_t));
        stream.dispatch(flag_, cellWords(coarser),
                        {{"finer", level == 1 ? voxels.occupancy : flags[level - 2]},
                         {"coarser", flags.back()},
                         {"counts", counts},
                         {"finerSize", levelResolution(size.resolution, level - 1)},
                         {"coarserSize", coarser},
                         {"level", level}});
    }
    size.nodes = stream.readAs<uint32_t>(counts, levels);
    size.nodes.front() = voxels.voxelCount;
    return flags;
}

}  // namespace voxray

#include "passes/cones/filter_voxels/svo_collapse.h"
#include "passes/common/compute/bit_words.h"

#include <algorithm>

namespace voxray {

SvoCollapse::SvoCollapse(ProgramOwner& owner)
    : markUniform_(owner, "svo_mark_uniform.comp"),
      copyMasks_(owner, "svo_collapse.comp", {{"MASKS", "1"}}),
      copyNodes_(owner, "svo_collapse.comp", {{"WORDS", "1"}}),
      fillTable_(owner, "svo_collapse_table.comp"),
      prefixSum_(owner, PrefixSum::Input::SetBits) {}

void SvoCollapse::run(CommandStream& stream, RadianceVoxels& radiance) const {
    // Mark uniform nodes, bottom-up.
    const OctreeSize& size = radiance.octree.size;
    const std::vector<uint32_t> first = size.first();
    const Buffer uniform(stream.device(), "octree uniform nodes", bitWords(size.nodeCount()) * sizeof(uint32_t));
    const Buffer counts(stream.device(), "octree uniform counts", size.levels() * sizeof(uint32_t));
    stream.fill(uniform, 0);
    stream.fill(counts, 0);
    for (uint32_t level = 1; level < size.levels(); ++level)
        stream.dispatch(markUniform_, size.nodes[level],
                        {radiance,
                         {"uniform_", uniform},
                         {"counts", counts},
                         {"level", level},
                         {"count", size.nodes[level]},
                         {"firstNode", first[level]}});

    // Each uniform node loses its eight children.
    const std::vector<uint32_t> uniformNodes = stream.readAs<uint32_t>(counts, size.levels());
    OctreeSize smaller = size;
    for (uint32_t level = 1; level < size.levels(); ++level) smaller.nodes[level - 1] -= 8 * uniformNodes[level];
    if (smaller.nodes != size.nodes) radiance = shrink(stream, radiance, uniform, smaller);
}

RadianceVoxels SvoCollapse::shrink(CommandStream& stream, const RadianceVoxels& radiance, const Buffer& uniform,
                                   const OctreeSize& smaller) const {
    Device& device = stream.device();
    RadianceVoxels result;
    result.layout = radiance.layout;
    result.grid = radiance.grid;
    allocateSvoValues(stream, allocateOctree(stream, smaller), result);

    // Top-down, as the octree was built: masks, ranks, then words, values and the list of the next level's
    // nodes.
    const std::vector<uint32_t> first = smaller.first();
    Buffer nodes(device, "octree root", sizeof(glm::uvec2));
    const glm::uvec2 root(1, 0);
    stream.upload(nodes, std::as_bytes(std::span(&root, 1)));
    for (uint32_t level = smaller.levels(); level-- > 0 && smaller.nodes[level] > 0;) {
        const uint32_t count = smaller.nodes[level], words = (count + 3) / 4;
        const uint32_t childCount = level > 0 ? smaller.nodes[level - 1] : 0;
        const Buffer masks(device, "octree masks", uint64_t(words) * sizeof(uint32_t));
        const Buffer ranks(device, "octree ranks", uint64_t(words) * sizeof(uint32_t));
        Buffer children(device, "octree children", uint64_t(std::max(childCount, 1u)) * sizeof(glm::uvec2));
        const Bindings step{{"octree", radiance.octree.header},
                            {"nodes", nodes},
                            {"uniform_", uniform},
                            {"level", level},
                            {"count", count},
                            {"firstNode", first[level]},
                            {"firstChild", level > 0 ? first[level - 1] : 0}};
        stream.dispatch(copyMasks_, words, {step.all(), {"masks", masks}});
        prefixSum_.run(stream, masks, ranks, words);
        stream.dispatch(copyNodes_, words,
                        {step.all(),
                         {"radianceVoxels", radiance.header},
                         {"ranks", ranks},
                         {"children", children},
                         {"collapsed", result.octree.header},
                         {"collapsedValues", result.header}});
        stream.finish();
        nodes = std::move(children);
    }

    for (uint32_t level = smaller.levels(); level-- > smaller.tableLevel();)
        stream.dispatch(fillTable_, levelVoxels(smaller.resolution, level), {result.octree, {"level", level}});
    stream.finish();
    return result;
}

}  // namespace voxray

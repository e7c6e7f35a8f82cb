#include "passes/cones/filter_voxels/svo_values.h"

#include <utility>

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of passes/cones/radiance/radiance_svo.glsl.
struct OctreeHeader {
    gpu::RadianceGrid grid;
    VkDeviceAddress values;
};
static_assert(sizeof(gpu::RadianceGrid) % sizeof(VkDeviceAddress) == 0);

}  // namespace

void allocateSvoValues(CommandStream& stream, Octree octree, RadianceVoxels& radiance) {
    Device& device = stream.device();
    const uint32_t directions = radiance.grid.directions;
    radiance.storage.clear();
    radiance.octree = std::move(octree);
    const OctreeSize& size = radiance.octree.size;
    const Buffer& values = radiance.storage.emplace_back(device, "octree values",
                                                         uint64_t(size.nodeCount()) * directions * sizeof(glm::uvec2));
    radiance.header = Buffer(device, "octree values' header", sizeof(OctreeHeader));
    const OctreeHeader header{radiance.grid, values.address()};
    stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));

    // The values of NO_NODE are 0.
    const glm::uvec2 zero(0);
    for (uint64_t face = 0; face < directions; ++face)
        stream.upload(values, std::as_bytes(std::span(&zero, 1)), face * size.nodeCount() * sizeof(zero));
}

SvoFilter::SvoFilter(ProgramOwner& owner) : filter_(owner, "svo_filter.comp") {}

void SvoFilter::run(CommandStream& stream, const RadianceVoxels& radiance, const Buffer& changed) const {
    const OctreeSize& size = radiance.octree.size;
    const std::vector<uint32_t> first = size.first();
    for (uint32_t level = 1; level < size.levels(); ++level)
        stream.dispatch(filter_, size.nodes[level],
                        {radiance, {"changed", changed}, {"firstNode", first[level]}, {"count", size.nodes[level]}});
}

}  // namespace voxray

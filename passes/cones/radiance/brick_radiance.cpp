#include "passes/cones/radiance/brick_radiance.h"

#include <utility>

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of passes/cones/radiance/radiance_svo_bricks.glsl.
struct Header {
    gpu::RadianceGrid grid;
    VkDeviceAddress nodes, bricks, scale;
};
static_assert(sizeof(gpu::RadianceGrid) % sizeof(VkDeviceAddress) == 0);

Defines brickDefines() {
    RadianceVoxels radiance;
    radiance.layout = RadianceLayout::SvoBricks;
    return radiance.defines();
}

}  // namespace

BrickRadiance::BrickRadiance(ProgramOwner& owner)
    : transfer_(owner, "brick_transfer.comp", brickDefines()), filter_(owner, "brick_filter.comp", brickDefines()) {}

void BrickRadiance::plan(PassPlan& plan, RadianceVoxels& radiance) {
    radiance.grid.unit = 1;  // BrickScale has it.
    radiance.storage = std::vector<Buffer>(2);
    plan.buffer(radiance.storage[0], "bricks' scale", sizeof(uint32_t));
    plan.buffer(radiance.header, "octree of bricks' header", sizeof(Header));
}

void BrickRadiance::setOctree(CommandStream& stream, const BrickOctree& octree, RadianceVoxels& radiance) const {
    Buffer& bricks = radiance.storage[1];
    uint64_t bytes = octree.brickCount * kBrickBytes;
    if (!bricks || bricks.bytes() < bytes) {
        if (bricks) bytes += bytes / 8;  // Spare, as in the pool of nodes.
        bricks = {};
        bricks = Buffer(stream.device(), "octree bricks", bytes);
    }
    const Header header{radiance.grid, octree.nodes.address(), bricks.address(), radiance.storage[0].address()};
    stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
}

void BrickRadiance::filter(CommandStream& stream, const BrickOctree& octree, const RadianceVoxels& radiance) const {
    transfer(stream, radiance, octree.levels[0], 0.5f);
    for (size_t level = 1; level < octree.levels.size(); ++level) {
        const gpu::LevelNodes& nodes = octree.levels[level];
        for (const auto& [minFaces, maxFaces] : {std::pair{0u, 0u}, std::pair{1u, 2u}, std::pair{3u, 3u}})
            stream.dispatch(filter_, nodesOf(nodes),
                            {radiance, {"nodes", nodes}, {"minFaces", minFaces}, {"maxFaces", maxFaces}});
        transfer(stream, radiance, nodes, 1);
    }
}

void BrickRadiance::transfer(CommandStream& stream, const RadianceVoxels& radiance, const gpu::LevelNodes& nodes,
                             float weight) const {
    for (uint32_t axis = 0; axis < 3; ++axis)
        for (const uint32_t isBack : {0u, 1u})
            stream.dispatch(transfer_, nodesOf(nodes),
                            {radiance, {"nodes", nodes}, {"axis", axis}, {"weight", weight}, {"isBack", isBack}});
}

}  // namespace voxray

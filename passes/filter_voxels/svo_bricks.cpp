#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/octree/brick_octree.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {
namespace {

/// The buffer `radianceVoxels` of shaders/radiance/radiance_svo_bricks.glsl.
struct Header {
    gpu::RadianceGrid grid;
    VkDeviceAddress nodes, bricks, scale;
};
static_assert(sizeof(gpu::RadianceGrid) % sizeof(VkDeviceAddress) == 0);

struct LeavesPush {
    gpu::VoxelGrid grid;
    float emission;
    uint32_t firstNode, count, isMeasured;
};
struct TransferPush {
    uint32_t firstNode, count, axis;
    float part;
    uint32_t isBack;
};
struct FilterPush {
    uint32_t firstNode, count, firstSides, lastSides;
};

/// The occupied voxels of a grid that is held whole.
VoxelBits readOccupancy(CommandStream& stream, const SurfaceVoxels& voxels) {
    const gpu::VoxelGrid& grid = voxels.grid;
    const std::vector<uint32_t> words = stream.readAs<uint32_t>(voxels.occupancy, voxels.words());
    VoxelBits bits(grid.resolution);
    size_t word = 0;
    for (uint32_t z = 0; z < grid.resolution.z; ++z)
        for (uint32_t y = 0; y < grid.resolution.y; ++y)
            for (uint32_t x = 0; x < grid.wordsPerRow; ++x)
                for (uint32_t rest = words[word++]; rest; rest &= rest - 1)
                    bits.mark({32 * x + uint32_t(std::countr_zero(rest)), y, z});
    return bits;
}

/// The octree of Arnebäck 2017 as published: nodes with neighbours, bricks that are filled by transfers and
/// the three passes of its filter. Its topology is made on the host, and kept for as long as voxels are the
/// same. Docs: docs/svo.md.
class SvoBricksStorage final : public RadianceStorage {
 public:
    explicit SvoBricksStorage(const BrickParams& params) : neighbors_(params.brickNeighbors) {}

    void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) override {
        const gpu::RadianceGrid& grid = radiance.grid;
        const Geometry& geometry = plan.frame.scene->geometry;
        const bool moves = !movingRuns(geometry).empty();
        if (grid.directions != 1 || moves)
            throw Error(
                "filter_voxels: layout svo_bricks is as published: one value a voxel for all directions and "
                "surfaces that stay; here are {} directions and surfaces that {}. Set voxelize's "
                "'directions' to 1 and keep surfaces still, or set 'layout' to svo",
                grid.directions, moves ? "move" : "stay");
        radiance.grid.unit = 1;  // BrickScale has it.
        plan.reserve("octree of bricks (estimated)",
                     countBrickOctree(metVoxels(geometry, voxels.grid), neighbors_).bytes());
        radiance.storage = std::vector<Buffer>(3);
        plan.buffer(radiance.storage[0], "bricks' scale", sizeof(uint32_t));
        plan.buffer(radiance.header, "octree of bricks' header", sizeof(Header));
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        const auto program = [&](const char* file) {
            return makeComputeProgram(setup.device, setup.compiler.compile(file, radiance.defines()));
        };
        leaves_ = program("passes/filter_voxels/svo_bricks_leaves.comp");
        transfer_ = program("passes/filter_voxels/svo_bricks_transfer.comp");
        filter_ = program("passes/filter_voxels/svo_bricks_filter.comp");
        version_.reset();
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
             RadianceVoxels& radiance, float emission) override {
        CommandStream& stream = context.stream;
        if (version_ != voxels.version) build(context.device, stream, voxels, radiance);
        version_ = voxels.version;

        std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
        for (const Binding& binding : radiance.bindings()) bindings.push_back(binding);
        stream.fill(radiance.storage[0], 0);
        for (const uint32_t isMeasured : {0u, 1u})
            stream.dispatch(leaves_, bindings,
                            LeavesPush{voxels.grid, emission, first_[0], count_[0], isMeasured},
                            linearGroups(count_[0]));
        transfer(stream, radiance, 0, 0.5f);
        for (uint32_t level = 1; level < first_.size(); ++level) {
            for (const auto& [from, to] : {std::pair{0u, 0u}, std::pair{1u, 2u}, std::pair{3u, 3u}})
                stream.dispatch(filter_, radiance.bindings(),
                                FilterPush{first_[level], count_[level], from, to},
                                linearGroups(count_[level]));
            transfer(stream, radiance, level, 1);
        }
    }

 private:
    void build(Device& device, CommandStream& stream, const SurfaceVoxels& voxels, RadianceVoxels& radiance) {
        const BrickOctree octree = buildBrickOctree(readOccupancy(stream, voxels), neighbors_);
        first_ = octree.first;
        count_ = octree.count;
        Buffer& nodes = radiance.storage[1];
        Buffer& bricks = radiance.storage[2];
        nodes = {};
        bricks = {};
        nodes = Buffer(device, "octree nodes", octree.nodes.size() * kBrickNodeBytes);
        bricks = Buffer(device, "octree bricks", octree.bricks * kBrickBytes);
        stream.upload(nodes, octree.nodes);
        const Header header{radiance.grid, nodes.address(), bricks.address(), radiance.storage[0].address()};
        stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
    }

    /// @param part of the sum of two bricks' values: 1, or 1/2 for their mean.
    void transfer(CommandStream& stream, const RadianceVoxels& radiance, uint32_t level, float part) {
        for (uint32_t axis = 0; axis < 3; ++axis)
            for (const uint32_t isBack : {0u, 1u})
                stream.dispatch(transfer_, radiance.bindings(),
                                TransferPush{first_[level], count_[level], axis, part, isBack},
                                linearGroups(count_[level]));
    }

    bool neighbors_;
    Program leaves_, transfer_, filter_;
    std::optional<uint64_t> version_;      ///< Of the voxels that it is built of.
    std::vector<uint32_t> first_, count_;  ///< Nodes of each level, leaves first.
};

}  // namespace

std::unique_ptr<RadianceStorage> makeSvoBricksStorage(const BrickParams& params) {
    return std::make_unique<SvoBricksStorage>(params);
}

}  // namespace voxray

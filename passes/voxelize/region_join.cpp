#include "passes/voxelize/region_join.h"

#include <algorithm>

#include "passes/common/dispatch.h"

namespace voxray {
namespace {

struct BitsPush {
    uint32_t rows;
    uint32_t wordsPerRow;
};

}  // namespace

RegionJoin::RegionJoin(Device& device, const ShaderCompiler& compiler)
    : bits_(makeComputeProgram(device, compiler.compile("passes/voxelize/region_bits.comp"))),
      join_(makeComputeProgram(device, compiler.compile("passes/voxelize/region_join.comp"))),
      materials_(makeComputeProgram(device, compiler.compile("passes/voxelize/region_materials.comp"))) {}

void RegionJoin::occupancy(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& former,
                           SurfaceVoxels& fresh) {
    Device& device = stream.device();
    const Buffer bits(device, "voxel region", former.occupancy.bytes());
    stream.fill(bits, 0);
    const std::vector<VoxelBox> list = region.slots();
    Buffer boxes;
    if (!list.empty()) {
        boxes = Buffer(device, "boxes of voxels", list.size() * sizeof(VoxelBox));
        stream.upload(boxes, list);
        uint64_t words = 0;  // Of the largest box, at most.
        for (const VoxelBox& box : list)
            words = std::max(words, (uint64_t(box.size.x) / 32 + 2) * box.size.y * box.size.z);
        const glm::uvec3 groups = linearGroups(words);
        stream.dispatch(bits_, {{"boxes", boxes}, {"region", bits}},
                        BitsPush{heldVoxels(former.grid).size.y, former.grid.wordsPerRow},
                        {groups.x, groups.y, uint32_t(list.size())});
    }

    joined_ = Buffer(device, "voxel occupancy", former.occupancy.bytes());
    const uint32_t words = uint32_t(former.words());
    stream.dispatch(
        join_,
        {{"region", bits}, {"fresh", fresh.occupancy}, {"before", former.occupancy}, {"joined", joined_}},
        words, linearGroups(words));
    stream.finish();
}

void RegionJoin::materials(CommandStream& stream, const PopulationPrefixSum& prefixSum,
                           const SurfaceVoxels& fresh, SurfaceVoxels& former) {
    Device& device = stream.device();
    const uint32_t words = uint32_t(former.words());
    Buffer rank(device, "voxel ranks", former.rank.bytes());
    former.voxelCount = prefixSum.run(stream, joined_, rank, words);
    LargeBuffer materials(device, "voxel materials",
                          std::max<uint64_t>(former.voxelCount, 1) * sizeof(gpu::VoxelMaterial));
    if (former.voxelCount == 0) stream.fill(materials, 0);
    stream.dispatch(materials_,
                    {{"fresh", fresh.occupancy},
                     {"freshRank", fresh.rank},
                     {"FreshMaterialsAt", fresh.materials.at()},
                     {"former", former.occupancy},
                     {"formerRank", former.rank},
                     {"FormerMaterialsAt", former.materials.at()},
                     {"voxelOccupancy", joined_},
                     {"voxelRank", rank},
                     {"VoxelMaterialsAt", materials.at()}},
                    words, linearGroups(words));
    stream.finish();
    former.occupancy = std::move(joined_);
    former.rank = std::move(rank);
    former.materials = std::move(materials);
}

}  // namespace voxray

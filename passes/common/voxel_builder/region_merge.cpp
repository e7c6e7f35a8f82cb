#include "passes/common/voxel_builder/region_merge.h"

#include <algorithm>

namespace voxray {
namespace {

constexpr uint32_t kBoxThreads = 64;  // As in mark_region.comp.

}  // namespace

RegionMerge::RegionMerge(ProgramOwner& owner)
    : bits_(owner, "mark_region.comp"),
      merge_(owner, "merge_occupancy.comp"),
      materials_(owner, "merge_materials.comp") {}

Buffer RegionMerge::bits(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& voxels) const {
    Device& device = stream.device();
    Buffer bits(device, "voxel region", voxels.occupancy.bytes());
    stream.fill(bits, 0);
    const std::vector<VoxelBox> list = region.wrappedBoxes();
    Buffer boxes;
    if (!list.empty()) {
        boxes = Buffer(device, "boxes of voxels", list.size() * sizeof(VoxelBox));
        stream.upload(boxes, list);
        uint64_t words = 0;  // Upper bound for the largest box.
        for (const VoxelBox& box : list)
            words = std::max(words, (uint64_t(box.size.x) / 32 + 2) * box.size.y * box.size.z);
        const glm::uvec3 groups = Invocations(words).groups({kBoxThreads, 1, 1});
        stream.dispatch(bits_, glm::uvec3(groups.x * kBoxThreads, groups.y, list.size()),
                        {{"boxes", boxes},
                         {"region", bits},
                         {"rows", windowVoxels(voxels.grid).size.y},
                         {"wordsPerRow", voxels.grid.wordsPerRow}});
    }
    stream.finish();
    return bits;
}

Buffer RegionMerge::merged(CommandStream& stream, const Buffer& bits, const Buffer& previous,
                           const Buffer& rebuilt) const {
    Buffer merged(stream.device(), "voxel occupancy", previous.bytes());
    const uint32_t words = uint32_t(previous.bytes() / sizeof(uint32_t));
    stream.dispatch(
        merge_, words,
        {{"region", bits}, {"rebuilt", rebuilt}, {"previous", previous}, {"merged", merged}, {"words", words}});
    stream.finish();
    return merged;
}

void RegionMerge::occupancy(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& previous,
                            SurfaceVoxels& rebuilt) {
    merged_ = merged(stream, bits(stream, region, previous), previous.occupancy, rebuilt.occupancy);
}

void RegionMerge::materials(CommandStream& stream, const PrefixSum& prefixSum, const SurfaceVoxels& rebuilt,
                            SurfaceVoxels& previous) {
    Device& device = stream.device();
    const uint32_t words = uint32_t(previous.words());
    Buffer rank(device, "voxel ranks", previous.rank.bytes());
    previous.voxelCount = prefixSum.run(stream, merged_, rank, words);
    LargeBuffer materials(device, "voxel materials",
                          std::max<uint64_t>(previous.voxelCount, 1) * sizeof(gpu::PackedVoxelMaterial));
    if (previous.voxelCount == 0) stream.fill(materials, 0);
    stream.dispatch(materials_, words,
                    {{"rebuilt", rebuilt.occupancy},
                     {"rebuiltRank", rebuilt.rank},
                     {"RebuiltMaterialsRef", rebuilt.materials.ref()},
                     {"previous", previous.occupancy},
                     {"previousRank", previous.rank},
                     {"PreviousMaterialsRef", previous.materials.ref()},
                     {"voxelOccupancy", merged_},
                     {"voxelRank", rank},
                     {"VoxelMaterialsRef", materials.ref()},
                     {"words", words}});
    stream.finish();
    previous.occupancy = std::move(merged_);
    previous.rank = std::move(rank);
    previous.materials = std::move(materials);
}

}  // namespace voxray

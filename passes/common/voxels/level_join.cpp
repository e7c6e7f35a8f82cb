#include "passes/common/voxels/level_join.h"

#include <algorithm>

namespace voxray {
namespace {

constexpr uint64_t kWord = sizeof(uint32_t);

/// Makes the buffers, and uploads the levels and their split bits.
std::vector<gpu::VoxelLevel> makeLevels(PassContext& context, const std::vector<LevelSource>& sources,
                                        VoxelLevels& joined) {
    std::vector<gpu::VoxelLevel> levels;
    uint64_t words = 0, splitWords = 0;
    for (const LevelSource& source : sources) {
        levels.push_back(source.level);
        levels.back().grid.firstWord = uint32_t(words);
        words += source.voxels->words();
        if (source.split) splitWords += source.voxels->words();
    }
    ensureSize(joined.levels, context.device, "levels of voxels", levels.size() * sizeof(gpu::VoxelLevel));
    ensureSize(joined.occupancy, context.device, "voxel occupancy", (words + splitWords) * kWord);
    ensureSize(joined.rank, context.device, "voxel ranks", words * kWord);
    context.stream.upload(joined.levels, levels);
    uint64_t target = words * kWord;
    for (const LevelSource& source : sources) {
        if (!source.split) continue;
        context.stream.copy(*source.split, joined.occupancy, source.split->bytes(), 0, target);
        target += source.split->bytes();
    }
    return levels;
}

}  // namespace

LevelJoin::LevelJoin(ProgramOwner& owner)
    : markLevel_(owner, "mark_level.comp"),
      copyAreas_(owner, "copy_areas.comp"),
      prefixSum_(owner, PrefixSum::Input::SetBits) {}

void LevelJoin::run(PassContext& context, const std::vector<LevelSource>& sources, VoxelLevels& joined) const {
    const std::vector<gpu::VoxelLevel> levels = makeLevels(context, sources, joined);
    for (uint32_t l = 0; l < levels.size(); ++l) {
        const SurfaceVoxels& window = *sources[l].voxels;
        context.dispatch(markLevel_, window.words(),
                         {joined,
                          {"window", window.occupancy},
                          {"joined", joined.occupancy},
                          {"level", l},
                          {"words", uint32_t(window.words())}});
    }
    joined.voxelCount =
        prefixSum_.run(context.stream, joined.occupancy, joined.rank, uint32_t(joined.rank.bytes() / kWord));
    ensureSize(joined.unoccludedArea, context.device, "unoccluded area",
               std::max(joined.voxelCount, 1u) * uint64_t(kAreaWords) * kWord);
    for (uint32_t l = 0; l < levels.size(); ++l) {
        const SurfaceVoxels& window = *sources[l].voxels;
        context.dispatch(copyAreas_, window.words(),
                         {joined,
                          {"window", window.occupancy},
                          {"windowRank", window.rank},
                          {"WindowMaterialsRef", window.materials.ref()},
                          {"area", joined.unoccludedArea},
                          {"level", l},
                          {"words", uint32_t(window.words())}});
    }
}

}  // namespace voxray

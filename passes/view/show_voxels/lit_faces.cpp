#include "passes/view/show_voxels/lit_faces.h"

#include <algorithm>

namespace voxray {
namespace {

uint64_t ofFaces(uint64_t count) {
    return kFaces * std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

}  // namespace

LitFaces::LitFaces(ProgramOwner& owner)
    : countLit_(owner, "count_lit.comp"), countSeen_(owner, "count_seen.comp") {}

void LitFaces::count(CommandStream& stream, uint32_t voxels, const VoxelPatches& patches,
                     const ClusterVisibility& visibility, const ClusterLight& light) {
    makeOrKeep(litOfParts_, stream.device(), "lit faces of parts", ofFaces(patches.componentCount));
    makeOrKeep(seenByFaces_, stream.device(), "lit faces that faces see", ofFaces(voxels));
    stream.dispatch(countLit_, patches.componentCount,
                    {{"groups", patches.groups},
                     {"components", patches.components},
                     {"memberGroups", patches.memberGroups},
                     {"PatchDirectAt", light.direct.at()},
                     {"litOfParts", litOfParts_},
                     {"count", patches.componentCount}});
    stream.fill(seenByFaces_, 0);
    stream.dispatch(countSeen_, patches.groupCount,
                    {{"visibilityLists", visibility.chunkAddresses},
                     {"groups", patches.groups},
                     {"PatchDirectAt", light.direct.at()},
                     {"litOfParts", litOfParts_},
                     {"seenByFaces", seenByFaces_},
                     {"lists", visibility.layout},
                     {"count", patches.groupCount}});
}

}  // namespace voxray

#include "passes/view/show_voxels/lit_faces.h"

#include "passes/common/compute/uint_bytes.h"

namespace voxray {

LitFaces::LitFaces(ProgramOwner& owner)
    : countLitPatches_(owner, "count_lit_patches.comp"), countVisibleLit_(owner, "count_visible_lit.comp") {}

void LitFaces::count(CommandStream& stream, uint32_t voxels, const VoxelPatches& patches,
                     const ClusterVisibility& visibility, const ClusterLight& light) {
    ensureSize(litPatches_, stream.device(), "lit patches of components", uintBytes(patches.componentFaceCount));
    ensureSize(visibleLitPatches_, stream.device(), "lit patches that faces see", uintBytes(uint64_t(kFaces) * voxels));
    stream.dispatch(countLitPatches_, patches.componentCount,
                    {{"groups", patches.groups},
                     {"components", patches.components},
                     {"memberGroups", patches.memberGroups},
                     {"PatchDirectRef", light.direct.ref()},
                     {"litPatches", litPatches_},
                     {"count", patches.componentCount}});
    stream.fill(visibleLitPatches_, 0);
    stream.dispatch(countVisibleLit_, patches.groupCount,
                    {{"visibilityLists", visibility.chunkAddresses},
                     {"groups", patches.groups},
                     {"PatchDirectRef", light.direct.ref()},
                     {"litPatches", litPatches_},
                     {"visibleLitPatches", visibleLitPatches_},
                     {"listLayout", visibility.layout},
                     {"count", patches.groupCount}});
}

}  // namespace voxray

#include "passes/show_voxels/lit_faces.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct SeenPush {
    gpu::SeenLayout lists;
    uint32_t count;
};

uint64_t ofFaces(uint64_t count) {
    return kFaces * std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

}  // namespace

uint64_t LitFaces::bytes(uint64_t voxels) {
    return ofFaces(voxels) + ofFaces(kSidesPerVoxel * voxels);
}

void LitFaces::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    countLit_ = program("passes/show_voxels/count_lit.comp");
    countSeen_ = program("passes/show_voxels/count_seen.comp");
}

void LitFaces::count(CommandStream& stream, uint32_t voxels, const VoxelPatches& patches,
                     const ClusterVisibility& visibility, const ClusterLight& light) {
    makeOrKeep(litOfParts_, stream.device(), "lit faces of parts", ofFaces(patches.partCount));
    makeOrKeep(seenByFaces_, stream.device(), "lit faces that faces see", ofFaces(voxels));
    stream.dispatch(countLit_,
                    {{"sides", patches.sides},
                     {"parts", patches.parts},
                     {"members", patches.members},
                     {"PatchDirectAt", light.direct.at()},
                     {"litOfParts", litOfParts_}},
                    patches.partCount, linearGroups(patches.partCount));
    stream.fill(seenByFaces_, 0);
    stream.dispatch(countSeen_,
                    {{"seenChunks", visibility.addresses},
                     {"sides", patches.sides},
                     {"PatchDirectAt", light.direct.at()},
                     {"litOfParts", litOfParts_},
                     {"seenByFaces", seenByFaces_}},
                    SeenPush{visibility.layout, patches.sideCount}, linearGroups(patches.sideCount));
}

}  // namespace voxray

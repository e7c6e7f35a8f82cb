#include "passes/clusters/cluster_visibility/kept_rays.h"

#include <glm/common.hpp>

#include "passes/common/compute/uints.h"
#include "passes/common/voxel_builder/changed_voxels.h"

namespace voxray {
namespace {

/// A ray's side lies in the voxel that it hit or in one next to it, and is chosen by what lies in those next
/// to that one.
constexpr uint32_t kChoiceReach = 2;

/// Boxes, m, for rays to be tested against; the first one holds all others.
std::vector<Box> testedBoxes(const std::vector<Box>& changed, float voxelSize) {
    const glm::vec3 margin(voxelSize / 64);  // For rounding.
    std::vector<Box> boxes(1, changed.at(0));
    for (const Box& box : changed) {
        boxes[0] = {glm::min(boxes[0].min, box.min), glm::max(boxes[0].max, box.max)};
        boxes.push_back(box);
    }
    for (Box& box : boxes) box = {box.min - margin, box.max + margin};
    return boxes;
}

}  // namespace

KeptRays::KeptRays(ProgramOwner& owner)
    : firstPatchesOf_(owner, "first_patches.comp"),
      renumber_(owner, "renumber.comp"),
      keep_(owner, "keep.comp"),
      regions_(owner) {}

void KeptRays::begin(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                     const VoxelPatches& patches, const std::vector<Box>& changed) {
    Device& device = stream.device();
    const Buffer near = regions_.bits(
        stream, VoxelRegion(voxels.grid, changedVoxels(voxels.grid, changed, kChoiceReach)), voxels);
    newSides_ = Buffer(device, "new numbers of sides", uints(sides_));
    beganAt_ = Buffer(device, "where patches of sides began", uints(patches.sideCount));
    stream.fill(newSides_, NO_SIDE);
    stream.dispatch(renumber_, patches.sideCount,
                    {{"sides", patches.sides},
                     {"previousSides", patches.previousSides},
                     {"coordinates", clusters.coordinates},
                     {"near", near},
                     {"firstPatches", firstPatches_},
                     {"newSides", newSides_},
                     {"beganAt", beganAt_},
                     {"grid", voxels.grid},
                     {"sideCount", patches.sideCount}});

    before_ = std::move(met_);
    met_.clear();
    std::vector<uint64_t> addresses;
    for (const Buffer& chunk : before_) addresses.push_back(chunk.address());
    if (addresses.empty()) addresses.resize(1);
    addresses_ = Buffer(device, "addresses of what rays met", addresses.size() * sizeof(uint64_t));
    stream.upload(addresses_, addresses);
    const std::vector<Box> tested = testedBoxes(changed, voxels.grid.voxelSize);
    boxes_ = Buffer(device, "boxes that rays pass", tested.size() * sizeof(Box));
    stream.upload(boxes_, tested);
    stream.finish();
    isActive_ = true;
}

void KeptRays::keep(CommandStream& stream, const Bindings& rays, uint32_t count) const {
    stream.dispatch(keep_, count,
                    {rays.all(),
                     {"boxes", boxes_},
                     {"before", addresses_},
                     {"newSides", newSides_},
                     {"beganAt", beganAt_}});
}

const Buffer& KeptRays::add(Device& device, uint64_t words) {
    return met_.emplace_back(device, "what rays met", uints(words));
}

void KeptRays::remember(CommandStream& stream, const VoxelPatches& patches) {
    stream.finish();
    isActive_ = false;
    before_.clear();
    addresses_ = {}, newSides_ = {}, beganAt_ = {}, boxes_ = {}, firstPatches_ = {};
    sides_ = patches.sideCount;
    firstPatches_ = Buffer(stream.device(), "first patches of sides", uints(sides_));
    stream.dispatch(firstPatchesOf_, sides_,
                    {{"sides", patches.sides}, {"firstPatches", firstPatches_}, {"sideCount", sides_}});
    stream.finish();
}

void KeptRays::clear() {
    met_.clear();
    firstPatches_ = {};
    sides_ = 0;
}

}  // namespace voxray

#include "passes/clusters/find_patches/component_labeling.h"

#include <bit>

#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/uint_bytes.h"

namespace voxray {

ComponentLabeling::ComponentLabeling(ProgramOwner& owner)
    : prefixSum_(owner, PrefixSum::Input::Uints),
      compaction_(owner),
      histogram_(owner),
      radixSort_(owner),
      iota_(owner, "passes/clusters/iota.comp"),
      propagateLabels_(owner, "propagate_labels.comp"),
      flagRoots_(owner, "flag_component_roots.comp"),
      numberComponents_(owner, "number_components.comp"),
      assignComponents_(owner, "assign_components.comp"),
      initComponents_(owner, "init_components.comp"),
      numberFaces_(owner, "number_component_faces.comp") {}

void ComponentLabeling::run(CommandStream& stream, const VoxelClusters& clusters, const NeighborCandidates& candidates,
                            VoxelPatches& patches) {
    Device& device = stream.device();
    const uint32_t groups = patches.groupCount, words = uint32_t(bitWords(groups));
    const Buffer labels(device, "labels of surface groups", uintBytes(groups));
    const Buffer changed(device, "labels that changed", uintBytes(1));
    stream.dispatch(iota_, groups, {{"values", labels}, {"count", groups}});
    for (bool isConverged = false; !isConverged;) {
        stream.fill(changed, 0);
        stream.dispatch(propagateLabels_, groups,
                        {{"groups", patches.groups},
                         {"firstCandidate", candidates.first},
                         {"CandidatesRef", candidates.groups.ref()},
                         {"clusterOfVoxel", clusters.clusterOfVoxel},
                         {"labels", labels},
                         {"changed", changed},
                         {"groupCount", groups}});
        isConverged = stream.readAs<uint32_t>(changed, 1)[0] == 0;
    }
    const Buffer flags(device, "flags of roots", uintBytes(words));
    const Buffer roots(device, "list of roots", uintBytes(groups));
    const Buffer componentOfRoot(device, "components of roots", uintBytes(groups));
    stream.dispatch(flagRoots_, words,
                    {{"groups", patches.groups},
                     {"clusterOfVoxel", clusters.clusterOfVoxel},
                     {"labels", labels},
                     {"flags", flags},
                     {"groupCount", groups}});
    patches.componentCount = compaction_.run(stream, flags, roots, words);
    stream.fill(componentOfRoot, NO_COMPONENT);
    stream.dispatch(numberComponents_, patches.componentCount,
                    {{"roots", roots}, {"componentOfRoot", componentOfRoot}, {"components", patches.componentCount}});

    // Sort the groups by component. The sort is stable: groups of a component stay ascending
    Buffer keys(device, "components of groups", uintBytes(groups));
    patches.componentOfGroup = Buffer(device, "components of groups", uintBytes(groups));
    patches.memberGroups = Buffer(device, "groups by component", uintBytes(groups));
    stream.dispatch(assignComponents_, groups,
                    {{"labels", labels},
                     {"componentOfRoot", componentOfRoot},
                     {"componentOfGroup", patches.componentOfGroup},
                     {"keys", keys},
                     {"memberGroups", patches.memberGroups},
                     {"groupCount", groups},
                     {"components", patches.componentCount}});
    radixSort_.record(stream, keys, patches.memberGroups, groups, uint32_t(std::bit_width(patches.componentCount)));
    stream.finish();
    radixSort_.freeScratch();
    listComponents(stream, patches);
}

void ComponentLabeling::listComponents(CommandStream& stream, VoxelPatches& patches) {
    Device& device = stream.device();
    const uint32_t count = patches.componentCount;
    const Buffer firstMembers(device, "first groups of components", uintBytes(count + 1));
    histogram_.record(stream, patches.componentOfGroup, firstMembers, patches.groupCount, count + 1);
    prefixSum_.run(stream, firstMembers, firstMembers, count + 1);
    patches.components =
        Buffer(device, "components of clusters", (uint64_t(count) + 1) * sizeof(gpu::ClusterComponent));
    const Buffer firstFaces(device, "first faces of components", uintBytes(count + 1));
    stream.dispatch(initComponents_, count + 1,
                    {{"groups", patches.groups},
                     {"memberGroups", patches.memberGroups},
                     {"firstMembers", firstMembers},
                     {"components", patches.components},
                     {"faceCounts", firstFaces},
                     {"count", count}});
    patches.componentFaceCount = prefixSum_.run(stream, firstFaces, firstFaces, count + 1);
    stream.dispatch(numberFaces_, count + 1,
                    {{"firstFaces", firstFaces}, {"components", patches.components}, {"count", count}});
    stream.finish();
}

}  // namespace voxray

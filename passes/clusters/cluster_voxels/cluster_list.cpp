#include "passes/clusters/cluster_voxels/cluster_list.h"

#include <bit>

namespace voxray {

ClusterList::ClusterList(ProgramOwner& owner)
    : histogram_(owner),
      prefixSum_(owner, PrefixSum::Of::Values),
      compaction_(owner),
      sort_(owner),
      flagNonempty_(owner, "flag_nonempty_clusters.comp"),
      initClusters_(owner, "init_clusters.comp"),
      renumberAssignment_(owner, "renumber_assignment.comp"),
      averageClusters_(owner, "average_clusters.comp") {}

void ClusterList::build(CommandStream& stream, const SurfaceVoxels& voxels,
                        const SlicClustering::Result& slic, VoxelClusters& clusters) {
    Device& device = stream.device();
    const uint32_t count = voxels.voxelCount, numbers = slic.seedCount + count, words = (numbers + 31) / 32;
    const auto uints = [&](const char* name, uint64_t n) {
        return Buffer(device, name, n * sizeof(uint32_t));
    };

    // Assign consecutive indices to nonempty clusters
    const Buffer memberCounts = uints("member counts", numbers),
                 firstMembers = uints("first members", numbers);
    const Buffer flags = uints("nonempty flags", words), nonempty = uints("nonempty clusters", numbers);
    const Buffer newNumbers = uints("new numbers", numbers);
    histogram_.record(stream, slic.assignment, memberCounts, count, numbers);
    prefixSum_.run(stream, memberCounts, firstMembers, numbers);
    stream.dispatch(flagNonempty_, words,
                    {{"memberCounts", memberCounts}, {"flags", flags}, {"numbers", numbers}});
    clusters.count = compaction_.run(stream, flags, nonempty, words);
    clusters.clusters = Buffer(device, "clusters", clusters.count * sizeof(gpu::VoxelCluster));
    stream.dispatch(initClusters_, clusters.count,
                    {{"numbers", nonempty},
                     {"memberCounts", memberCounts},
                     {"firstMembers", firstMembers},
                     {"newNumbers", newNumbers},
                     {"seeds", slic.seeds},
                     {"normals", slic.normals},
                     {"clusters", clusters.clusters},
                     {"clusterCount", clusters.count},
                     {"seedCount", slic.seedCount}});

    // Sort voxels by cluster. The sort is stable: voxels of a cluster stay ascending
    Buffer keys = uints("clusters of voxels", count);
    clusters.clusterOfVoxel = uints("clusters of voxels", count);
    clusters.memberVoxels = uints("voxels by cluster", count);
    stream.dispatch(renumberAssignment_, count,
                    {{"assignment", slic.assignment},
                     {"newNumbers", newNumbers},
                     {"clusterOfVoxel", clusters.clusterOfVoxel},
                     {"keys", keys},
                     {"memberVoxels", clusters.memberVoxels},
                     {"count", count},
                     {"clusters", clusters.count}});
    sort_.record(stream, keys, clusters.memberVoxels, count, uint32_t(std::bit_width(clusters.count)));
    stream.dispatch(averageClusters_, clusters.count,
                    {voxels,
                     {"memberVoxels", clusters.memberVoxels},
                     {"coordinates", clusters.coordinates},
                     {"normals", slic.normals},
                     {"clusters", clusters.clusters},
                     {"count", clusters.count}});
    stream.finish();
}

}  // namespace voxray

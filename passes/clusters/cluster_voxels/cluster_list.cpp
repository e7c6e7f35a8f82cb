#include "passes/clusters/cluster_voxels/cluster_list.h"
#include "passes/common/compute/bit_words.h"

namespace voxray {

ClusterList::ClusterList(ProgramOwner& owner)
    : histogram_(owner),
      compaction_(owner),
      flagNonempty_(owner, "flag_nonempty_clusters.comp"),
      initClusters_(owner, "init_clusters.comp"),
      renumberAssignment_(owner, "renumber_assignment.comp") {}

void ClusterList::build(CommandStream& stream, uint32_t voxelCount, const SlicClustering::Result& slic,
                        VoxelClusters& clusters) {
    Device& device = stream.device();
    const uint32_t numbers = slic.seedCount + voxelCount, words = uint32_t(bitWords(numbers));
    const auto uints = [&](const char* name, uint64_t n) { return Buffer(device, name, n * sizeof(uint32_t)); };
    const Buffer memberCounts = uints("member counts", numbers), newNumbers = uints("new numbers", numbers);
    const Buffer flags = uints("nonempty flags", words), nonempty = uints("nonempty clusters", numbers);
    histogram_.record(stream, slic.assignment, memberCounts, voxelCount, numbers);
    stream.dispatch(flagNonempty_, words, {{"memberCounts", memberCounts}, {"flags", flags}, {"numbers", numbers}});
    clusters.count = compaction_.run(stream, flags, nonempty, words);
    clusters.clusters = Buffer(device, "clusters", clusters.count * sizeof(gpu::VoxelCluster));
    stream.dispatch(initClusters_, clusters.count,
                    {{"numbers", nonempty},
                     {"memberCounts", memberCounts},
                     {"newNumbers", newNumbers},
                     {"seeds", slic.seeds},
                     {"normals", slic.normals},
                     {"clusters", clusters.clusters},
                     {"clusterCount", clusters.count},
                     {"seedCount", slic.seedCount}});
    clusters.clusterOfVoxel = uints("clusters of voxels", voxelCount);
    stream.dispatch(renumberAssignment_, voxelCount,
                    {{"assignment", slic.assignment},
                     {"newNumbers", newNumbers},
                     {"clusterOfVoxel", clusters.clusterOfVoxel},
                     {"count", voxelCount}});
    stream.finish();
}

}  // namespace voxray

#include "passes/clusters/cluster_voxels/cluster_list.h"

#include <bit>

namespace voxray {

ClusterList::ClusterList(ProgramOwner& owner)
    : histogram_(owner),
      prefixSum_(owner, PrefixSum::Of::Values),
      compaction_(owner),
      sort_(owner),
      occupied_(owner, "occupied.comp"),
      begin_(owner, "begin.comp"),
      renumber_(owner, "renumber.comp"),
      describe_(owner, "describe.comp") {}

void ClusterList::make(CommandStream& stream, const SurfaceVoxels& voxels,
                       const ClusterGrowth::Result& growth, VoxelClusters& clusters) {
    Device& device = stream.device();
    const uint32_t count = voxels.voxelCount, numbers = growth.seeds + count, words = (numbers + 31) / 32;
    const auto uints = [&](const char* name, uint64_t n) {
        return Buffer(device, name, n * sizeof(uint32_t));
    };

    // Clusters that have voxels, and where their members begin
    const Buffer members = uints("voxels by number", numbers), before = uints("voxels before", numbers);
    const Buffer flags = uints("numbers in use", words), kept = uints("clusters kept", numbers);
    const Buffer renumbered = uints("new numbers", numbers);
    histogram_.record(stream, growth.owners, members, count, numbers);
    prefixSum_.run(stream, members, before, numbers);
    stream.dispatch(occupied_, words, {{"members", members}, {"flags", flags}, {"numbers", numbers}});
    clusters.count = compaction_.run(stream, flags, kept, words);
    clusters.clusters = Buffer(device, "clusters", clusters.count * sizeof(gpu::VoxelCluster));
    stream.dispatch(begin_, clusters.count,
                    {{"numbers", kept},
                     {"members", members},
                     {"before", before},
                     {"renumbered", renumbered},
                     {"seeds", growth.seedList},
                     {"normals", growth.normals},
                     {"clusters", clusters.clusters},
                     {"clusterCount", clusters.count},
                     {"firstOwn", growth.seeds}});

    // Voxels by cluster: the sort is stable, so those of a cluster stay in their order
    Buffer keys = uints("clusters of voxels", count);
    clusters.ofVoxel = uints("clusters of voxels", count);
    clusters.members = uints("voxels by cluster", count);
    stream.dispatch(renumber_, count,
                    {{"owners", growth.owners},
                     {"renumbered", renumbered},
                     {"ofVoxel", clusters.ofVoxel},
                     {"keys", keys},
                     {"members", clusters.members},
                     {"count", count},
                     {"clusters", clusters.count}});
    sort_.record(stream, keys, clusters.members, count, uint32_t(std::bit_width(clusters.count)));
    stream.dispatch(describe_, clusters.count,
                    {voxels,
                     {"members", clusters.members},
                     {"coordinates", clusters.coordinates},
                     {"normals", growth.normals},
                     {"clusters", clusters.clusters},
                     {"count", clusters.count}});
    stream.finish();
}

}  // namespace voxray

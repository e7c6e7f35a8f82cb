#pragma once

#include <array>
#include <optional>
#include <utility>

#include "graph/registry.h"
#include "passes/common/clusters/cluster_visibility.h"
#include "passes/common/clusters/voxel_clusters.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/voxel_march/voxel_march.h"

namespace voxray {

/// What rays of faces meet.
enum class FaceRays { Voxels, Exact };
template <>
struct EnumNames<FaceRays> {
    static constexpr std::array names{std::pair{FaceRays::Voxels, "voxels"},
                                      std::pair{FaceRays::Exact, "exact"}};
};

/// What the rays of a face are distributed about.
enum class FaceHemisphere { Surface, Face };
template <>
struct EnumNames<FaceHemisphere> {
    static constexpr std::array names{std::pair{FaceHemisphere::Surface, "surface"},
                                      std::pair{FaceHemisphere::Face, "face"}};
};

/// Finds which clusters each face of each voxel sees, once for a scene: light is gathered from these lists.
/// Source: Cosin and Patow 2022, section 4.3.
class FindClusterVisibility final : public Pass {
 public:
    static constexpr const char* kName = "cluster_visibility";
    static constexpr const char* kHelp =
        "Sends rays from each face of each voxel, by the cosine about its surfaces' normal, and lists the "
        "clusters that they meet, with the number of rays for each: a form factor. What is near is listed by "
        "its voxels. Biased by: voxel size (surfaces are as thick as their voxels). Noisy by: rays. "
        "Source: Cosin and Patow 2022, section 4.3, with a walk that misses no voxel in place of "
        "Bresenham's.";
    struct Params {
        uint32_t rays = 128;
        float nearDistance = 4;
        FaceRays visibility = FaceRays::Voxels;
        FaceHemisphere hemisphere = FaceHemisphere::Surface;
        static constexpr auto schema() {
            return std::tuple{
                field("rays", &Params::rays, "From each face.", 1u, SEEN_MAX_RAYS),
                field(
                    "near_distance", &Params::nearDistance,
                    "What is nearer than this many voxels is seen by its voxels, and what is farther by its "
                    "clusters. 0: all by clusters. 10000: all by voxels, for comparison.",
                    0.0f, 10000.0f),
                field(
                    "visibility", &Params::visibility,
                    "voxels: rays walk through voxels. exact: from the scene's surfaces through the scene."),
                field(
                    "hemisphere", &Params::hemisphere,
                    "surface: rays leave by the cosine about the normal of the surfaces before a face. face: "
                    "about the face's own axis (the paper's).")};
        }
    };

    explicit FindClusterVisibility(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    uint32_t chunkFaces() const;
    /// Lists what `count` faces from `first` on see.
    void look(PassContext& context, uint32_t first, uint32_t count);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelClusters> clusters_;
    Port<ClusterVisibility> visibility_;
    VoxelMarch march_{VoxelWalk::Bricks};
    std::optional<Compaction> compaction_;
    std::optional<PrefixSum> prefixSum_;
    Program faceBits_, marchRays_, place_, aim_, see_, merge_, compact_;
    Buffer faces_, targets_, counts_, missed_, rays_, hits_;
    std::optional<std::pair<uint64_t, uint64_t>> version_;  ///< Of the voxels and their clusters.
};

}  // namespace voxray

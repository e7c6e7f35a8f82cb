#pragma once

#include <array>
#include <optional>
#include <utility>

#include "graph/registry.h"
#include "passes/cluster_visibility/kept_rays.h"
#include "passes/common/clusters/cluster_visibility.h"
#include "passes/common/clusters/voxel_patches.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/voxel_march/voxel_march.h"

namespace voxray {

/// What rays of faces meet.
enum class FaceRays { Exact, Voxels, Bresenham };
template <>
struct EnumNames<FaceRays> {
    static constexpr std::array names{std::pair{FaceRays::Exact, "exact"},
                                      std::pair{FaceRays::Voxels, "voxels"},
                                      std::pair{FaceRays::Bresenham, "bresenham"}};
};

/// What the rays of a face are distributed about.
enum class FaceHemisphere { Surface, Face };
template <>
struct EnumNames<FaceHemisphere> {
    static constexpr std::array names{std::pair{FaceHemisphere::Surface, "surface"},
                                      std::pair{FaceHemisphere::Face, "face"}};
};

/// Finds which clusters each patch of each voxel sees, once for a scene: light is gathered from these lists.
/// Where surfaces move, rays through the scene are traced again where these have changed.
/// Source: Cosin and Patow 2022, section 4.3.
class FindClusterVisibility final : public Pass {
 public:
    static constexpr const char* kName = "cluster_visibility";
    static constexpr const char* kHelp =
        "Sends rays from the surfels of each patch (a face of one of the sides in a voxel, find_patches), by "
        "the cosine about their normal, and lists the clusters' parts that they meet, with the number of "
        "rays for each: a form factor. What is near is listed by its voxels. Biased by: cluster size; "
        "through voxels also by voxel size (surfaces are as thick as their voxels). Noisy by: rays. "
        "Source: Cosin and Patow 2022, section 4.3.";
    struct Params {
        uint32_t rays = 128;
        float nearDistance = 4;
        FaceRays visibility = FaceRays::Exact;
        FaceHemisphere hemisphere = FaceHemisphere::Surface;
        static constexpr auto schema() {
            return std::tuple{
                field("rays", &Params::rays, "From each patch.", 1u, SEEN_MAX_RAYS).lessNoise(),
                field(
                    "near_distance", &Params::nearDistance,
                    "What is nearer than this many voxels is seen by its voxels, and what is farther by its "
                    "clusters. 0: all by clusters. 10000: all by voxels, for comparison.",
                    0.0f, 10000.0f),
                field("visibility", &Params::visibility,
                      "exact: rays go through the scene. voxels: through voxels, all that they meet. "
                      "bresenham: the paper's walk through voxels, which passes some by."),
                field(
                    "hemisphere", &Params::hemisphere,
                    "surface: rays leave by the cosine about the surfels' normal. face: about the face's own "
                    "axis (the paper's).")};
        }
    };

    explicit FindClusterVisibility(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    struct RayPush;
    bool seesPatches() const { return params_.nearDistance > 0; }
    bool isExact() const { return params_.visibility == FaceRays::Exact; }
    /// Lists what `count` patches from `first` on see.
    void look(PassContext& context, uint32_t first, uint32_t count);
    /// Writes what their rays met, those that are to be traced and those that are kept. @return rays traced.
    uint32_t traceRays(PassContext& context, RayPush push, const Buffer& met);
    void marchRays(PassContext& context, const RayPush& push, const Buffer& met);
    /// Lists the rays that are to be traced. @return how many.
    uint32_t listRays(PassContext& context, const RayPush& push, const Buffer& met);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelClusters> clusters_;
    Port<const VoxelPatches> patches_;
    Port<ClusterVisibility> visibility_;
    VoxelMarch march_{VoxelWalk::Bricks};
    std::optional<PrefixSum> prefixSum_;
    std::optional<Compaction> compaction_;
    std::optional<KeptRays> kept_;  ///< Where surfaces move.
    uint64_t listBytes_ = 0;        ///< That are expected of the lists.
    uint64_t traced_ = 0;           ///< Rays, in this build.
    Program listFaces_, marchRays_, all_, emit_, choose_, targetsOf_, merge_, compact_;
    Buffer faces_, met_, targets_, counts_, missed_;  ///< Scratch.
    Buffer flags_, list_, rays_, hits_, proposals_, between_, occluded_;
    std::optional<std::pair<uint64_t, uint64_t>> version_;  ///< Of the voxels and their patches.
};

}  // namespace voxray

#pragma once

#include <array>
#include <optional>
#include <tuple>

#include "graph/registry.h"
#include "passes/common/clusters/cluster_light.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/surfels/surfel_light.h"
#include "passes/common/surfels/surfels.h"
#include "passes/inject_clusters/lit_points.h"

namespace voxray {

/// Where the direct light comes from that clusters send on.
enum class ClusterDirect { Injected, ShadowRays };
template <>
struct EnumNames<ClusterDirect> {
    static constexpr std::array names{std::pair{ClusterDirect::Injected, "injected"},
                                      std::pair{ClusterDirect::ShadowRays, "shadow_rays"}};
};

/// What tells whether a surface sees a light.
enum class LitTest { Surfels, Points };
template <>
struct EnumNames<LitTest> {
    static constexpr std::array names{std::pair{LitTest::Surfels, "surfels"},
                                      std::pair{LitTest::Points, "points"}};
};

/// Light of voxels, summed up to what their clusters send, and bounced from face to face by the lists of what
/// faces see. Source: Cosin and Patow 2022, section 4.4.
class InjectClusters final : public Pass {
 public:
    static constexpr const char* kName = "inject_clusters";
    static constexpr const char* kHelp =
        "Sums the light of lit voxels, whichever pass injected it, or that of their surfels, up to their "
        "clusters: what each part of a cluster sends from each of its six faces. With bounces, light goes "
        "on from cluster to face and on, by the lists of cluster_visibility. Biased by: the size of "
        "clusters, over which light is averaged; injected light by that of voxels, too, which may hold both "
        "sides of a wall. Noisy by: bounce_patches. Source: Cosin and Patow 2022, section 4.4.";
    struct Params {
        uint32_t bounces = 0;
        uint32_t bouncePatches = 0;
        ClusterDirect direct = ClusterDirect::Injected;
        LitTest litTest = LitTest::Surfels;
        uint32_t lightSamples = 4;
        static constexpr auto schema() {
            return std::tuple{
                field("bounces", &Params::bounces,
                      "Bounces between clusters, after those of the injection and before the one "
                      "of gather_clusters.",
                      0u, 64u),
                field("bounce_patches", &Params::bouncePatches,
                      "How many patches of each face of a part stand for all of them in a bounce, picked by "
                      "area and again in each bounce. 0: all, one by one.",
                      0u, 64u)
                    .lessNoise()
                    .onlyWith(noneOf(&Params::bounces, {0u})),
                field("direct", &Params::direct,
                      "injected: the light that an injection left in the voxels. shadow_rays: direct light "
                      "of the surfels (place_surfels) by rays to the lights, without an injection."),
                field(
                    "lit_test", &Params::litTest,
                    "surfels: each surfel is lit where its own shadow ray arrives. points: all surfels of a "
                    "voxel are where a light sees one of 18 points 1.5 voxels round its center and no "
                    "surface in the next voxel towards the light looks away from it (the paper's); for "
                    "punctual lights.")
                    .onlyWith(oneOf(&Params::direct, {ClusterDirect::ShadowRays})),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays from each surfel to the emissive surfaces, and to the environment.", 1u,
                      256u)
                    .onlyWith(oneOf(&Params::direct, {ClusterDirect::ShadowRays}))};
        }
    };

    explicit InjectClusters(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    bool testsPoints() const {
        return params_.direct == ClusterDirect::ShadowRays && params_.litTest == LitTest::Points;
    }
    bool bouncesParts() const { return params_.bounces > 0 && params_.bouncePatches > 0; }
    /// Direct light of each patch, and all that arrives before the first bounce in arriving_.
    void readInjected(PassContext& context, const ClusterLight& light);
    void measure(PassContext& context, const ClusterLight& light);
    /// Irradiance of the surfels of each side, by their shadow rays.
    void traceSurfels(PassContext& context, const LargeBuffer& ofSurfels);
    /// What is sent of arriving_ and of what has bounced so far.
    void reflect(PassContext& context, bool hasBounced);
    /// All bounces: of each patch, or between faces of parts.
    void bouncePatches(PassContext& context, ClusterLight& light);
    void bounceParts(PassContext& context, ClusterLight& light);
    /// Areas of the faces of parts, and a list of those that have any. @return how many.
    uint32_t listSenders(PassContext& context, const Buffer& partFaces, const Buffer& senders) const;
    /// Radiosity of patches out of what bounced between parts.
    void spread(PassContext& context, const ClusterLight& light, const Buffer& bounced) const;

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<const Surfels> surfels_;
    Port<const VoxelClusters> clusters_;
    Port<const VoxelPatches> patches_;
    Port<const ClusterVisibility> visibility_;
    Port<ClusterLight> light_;
    std::vector<LightSource> sources_;
    SurfelLight surfelLight_;
    LitPoints litPoints_;
    ClusterGather gather_;
    std::optional<Compaction> compaction_;
    Program injected_, place_, mean_, reflectSides_, sumParts_, senders_, bounceParts_, spread_;
    LargeBuffer arriving_, bounced_;
    Buffer direct_;                                                    ///< Scratch: of a chunk of surfels.
    std::optional<std::tuple<uint64_t, uint64_t, uint64_t>> version_;  ///< Of voxels, lists and light.
};

}  // namespace voxray

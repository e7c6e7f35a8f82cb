#pragma once

#include <array>
#include <optional>
#include <utility>

#include "passes/common/compute/compaction.h"
#include "passes/common/hybrid_leaves/hybrid_tracer.h"
#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/surfels/surfel_light.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/view/specular_lobes.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/gather_mirror/mirror_types.h"

namespace voxray {

/// Where direct light at what mirrors show comes from.
enum class MirrorDirect { Voxels, ShadowRays };
template <>
struct EnumNames<MirrorDirect> {
    static constexpr std::array names{std::pair{MirrorDirect::Voxels, "voxels"},
                                      std::pair{MirrorDirect::ShadowRays, "shadow_rays"}};
};

/// What finds the ends of rays: the scene's ray tracer, or one of two walks through hybrid leaves
/// (HybridWalk).
enum class MirrorWalk { Exact, Hierarchical, VoxelByVoxel };
template <>
struct EnumNames<MirrorWalk> {
    static constexpr std::array names{std::pair{MirrorWalk::Exact, "exact"},
                                      std::pair{MirrorWalk::Hierarchical, "hierarchical"},
                                      std::pair{MirrorWalk::VoxelByVoxel, "voxel_by_voxel"}};
};

/// What a ray through hybrid leaves becomes where it is wider than a voxel.
enum class WideRays { Rays, Cones };
template <>
struct EnumNames<WideRays> {
    static constexpr std::array names{std::pair{WideRays::Rays, "rays"}, std::pair{WideRays::Cones, "cones"}};
};

/// What a pixel's first mirror rays ended on.
struct MirrorEnds : Resource {
    Image parts;  ///< RGBA32F: on triangles, on cells of grids, as cones, nowhere; 0 where none went out.

    std::vector<Aov> aovs() const override {
        return {{&parts, {"ends.triangles", "ends.cells", "ends.cones", "ends.nowhere"}}};
    }
};

/// What mirror-like surfaces show: reflected rays from each texel of the g-buffer, lit where they end. Docs:
/// docs/mirrors.md. Source: Seok 2021 (rays for mirrors, cones for all else).
class GatherMirror final : public Pass {
 public:
    static constexpr const char* kName = "gather_mirror";
    static constexpr const char* kHelp =
        "Specular light of mirror-like surfaces by reflected rays, joined with the direct and the indirect "
        "light of other passes; lamps and environment that a mirror shows, and mirrors in mirrors. "
        "Biased by: voxel size (indirect light where rays end; direct light too with `direct_at_hits: "
        "voxels`); specular light of what mirrors show is left out where it is rougher than the hand-over; "
        "light that mirrors throw at other surfaces is in voxels only where their injection follows it; "
        "cells of hybrid leaves' grids reach a little farther than their surfaces. "
        "Noisy by: `rays` where surfaces are no perfect mirrors; light_samples. "
        "Source: Seok 2021, chapter 4.";
    struct Params {
        float maxRoughness = 0.1f;
        float blendRoughness = 0.1f;
        uint32_t rays = 1;
        uint32_t bounces = 4;
        MirrorWalk walk = MirrorWalk::Exact;
        WideRays wideRays = WideRays::Rays;
        MirrorDirect directAtHits = MirrorDirect::ShadowRays;
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("max_roughness", &Params::maxRoughness,
                      "Up to this roughness rays alone bring specular light. Perfect mirrors end at 0.0316.",
                      0.0f, 1.0f),
                field("blend_roughness", &Params::blendRoughness,
                      "Over this much more roughness rays hand over to the cones of gather_cones, or to none "
                      "where no pass writes 'lobes'.",
                      0.0f, 1.0f),
                field("rays", &Params::rays,
                      "Rays of each g-buffer texel whose surface is no perfect mirror; a mirror sends one.",
                      1u, 64u)
                    .lessNoise(),
                field("bounces", &Params::bounces,
                      "Mirrors that light meets one after another, at most, the one that the camera sees "
                      "among them; what the last one shows of further mirrors is black.",
                      1u, 32u),
                field("walk", &Params::walk,
                      "What finds the ends of rays. exact: the ray tracer. hierarchical, voxel_by_voxel: "
                      "leaves of "
                      "the octree, which hold triangles or grids of fine voxels, past empty space of all "
                      "sizes or, "
                      "as in the paper, through each finest voxel on the way, from the root each time."),
                field("wide_rays", &Params::wideRays,
                      "Rays through hybrid leaves that are wider than a voxel where they come to a surface. "
                      "rays: "
                      "they stay rays. cones: a cone through larger voxels goes on, which hold direct light, "
                      "too.")
                    .onlyWith(noneOf(&Params::walk, {MirrorWalk::Exact})),
                field("direct_at_hits", &Params::directAtHits,
                      "Direct light where rays end. voxels: as coarse as voxels. shadow_rays: exact, by a "
                      "shadow ray to each light; voxels bring indirect light alone."),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays to the emissive surfaces, and to the environment, from each ray's end.",
                      1u, 256u)
                    .lessNoise()
                    .onlyWith(oneOf(&Params::directAtHits, {MirrorDirect::ShadowRays}))};
        }
    };

    explicit GatherMirror(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    bool isHybrid() const { return params_.walk != MirrorWalk::Exact; }
    bool widens() const { return isHybrid() && params_.wideRays == WideRays::Cones; }
    bool shadowRays() const { return params_.directAtHits == MirrorDirect::ShadowRays; }
    gpu::MirrorBatch firstBatch(const Frame& frame, uint32_t samples, uint32_t frameIndex) const;
    /// Light in voxels, by face; kept until it changes.
    void updateFaces(PassContext& context);
    /// Sends the rays of a batch and adds up what they bring.
    void gather(PassContext& context, const gpu::MirrorBatch& batch);
    /// Finds where `count` rays end.
    void trace(PassContext& context, uint32_t depth, uint32_t count);
    /// Lights their ends. @return the number of rays that mirrors send on.
    uint32_t end(PassContext& context, const gpu::MirrorBatch& batch, uint32_t depth, uint32_t count);
    void resolve(PassContext& context, const gpu::MirrorBatch& batch);

    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<const HybridLeaves> leaves_;      ///< With a walk through them.
    Port<const RadianceVoxels> radiance_;  ///< Where rays become cones.
    Port<const SpecularLobes> lobes_;
    Port<const FrameImage> otherDirect_, otherIndirect_;
    Port<FrameImage> direct_, indirect_;
    Port<MirrorEnds> ends_;

    Program mark_, begin_, wide_, shade_, reflect_, resolve_;
    Sampler sampler_;
    std::optional<Compaction> compaction_;
    FaceIrradiance faces_;
    std::optional<std::pair<uint64_t, uint64_t>> facesVersion_;  ///< Of the voxels and the light in them.
    std::vector<LightSource> sources_;
    SurfelLight hitLight_;
    std::optional<HybridTracer> hybrid_;
    uint64_t triangleHits_ = 0, cellHits_ = 0, wideRays_ = 0, misses_ = 0;  ///< Of a frame.
    Image black_;
    Buffer grid_, grazing_, counts_;
    Buffer flags_, slots_, light_;        ///< Of a batch.
    std::array<Buffer, 2> paths_, rays_;  ///< Those on their way, and those that go on.
    std::array<Buffer, 2> starts_;        ///< Of rays through hybrid leaves, a gpu::RayStart each.
    Buffer hits_, surfels_, hitDirect_;
};

}  // namespace voxray

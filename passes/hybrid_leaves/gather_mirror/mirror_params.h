#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "base/schema.h"

namespace voxray {

/// How direct light at hits is computed.
enum class MirrorDirect { Voxels, ShadowRays };
template <>
struct EnumNames<MirrorDirect> {
    static constexpr std::array names{std::pair{MirrorDirect::Voxels, "voxels"},
                                      std::pair{MirrorDirect::ShadowRays, "shadow_rays"}};
};

/// What traces rays: the scene's ray tracer, or a traversal of hybrid leaves (HybridTraversal).
enum class MirrorTraversal { Exact, Hierarchical, VoxelByVoxel };
template <>
struct EnumNames<MirrorTraversal> {
    static constexpr std::array names{std::pair{MirrorTraversal::Exact, "exact"},
                                      std::pair{MirrorTraversal::Hierarchical, "hierarchical"},
                                      std::pair{MirrorTraversal::VoxelByVoxel, "voxel_by_voxel"}};
};

/// How a ray through hybrid leaves continues where it is wider than a voxel.
enum class WideRays { Rays, Cones };
template <>
struct EnumNames<WideRays> {
    static constexpr std::array names{std::pair{WideRays::Rays, "rays"}, std::pair{WideRays::Cones, "cones"}};
};

struct MirrorParams {
    float maxRoughness = 0.1f;
    float blendRoughness = 0.1f;
    uint32_t rays = 1;
    uint32_t bounces = 4;
    MirrorTraversal walk = MirrorTraversal::Exact;
    WideRays wideRays = WideRays::Rays;
    MirrorDirect directAtHits = MirrorDirect::ShadowRays;
    uint32_t lightSamples = 1;
    static constexpr auto schema() {
        return std::tuple{
            field("max_roughness", &MirrorParams::maxRoughness,
                  "Roughness up to which rays alone give specular light; surfaces below 0.0316 are perfect mirrors.",
                  0.0f, 1.0f),
            field("blend_roughness", &MirrorParams::blendRoughness,
                  "Range of roughness above max_roughness over which rays fade out, "
                  "in favour of the cones of gather_cones where a pass writes 'lobes'.",
                  0.0f, 1.0f),
            field("rays", &MirrorParams::rays,
                  "Rays of each G-buffer texel on a glossy surface; a perfect mirror has one.", 1u, 64u)
                .lessNoise(),
            field("bounces", &MirrorParams::bounces,
                  "Maximum reflections at mirrors along a path, including the one that the camera sees; "
                  "further mirrors are black.",
                  1u, 32u),
            field("walk", &MirrorParams::walk,
                  "What rays are traced through. exact: the scene, by the ray tracer. hierarchical, voxel_by_voxel: "
                  "leaves of the octree, which hold triangles or grids of finer voxels; "
                  "the first skips empty space at all scales, the second visits each voxel from the root, "
                  "as in the paper."),
            field("wide_rays", &MirrorParams::wideRays,
                  "How rays through hybrid leaves continue where they are wider than a voxel at a surface. "
                  "rays: as rays. cones: as a cone through larger voxels, which hold direct light as well.")
                .onlyWith(noneOf(&MirrorParams::walk, {MirrorTraversal::Exact})),
            field("direct_at_hits", &MirrorParams::directAtHits,
                  "Direct light at hits. voxels: from voxels, at their resolution. "
                  "shadow_rays: exact, by a shadow ray to each light."),
            field("light_samples", &MirrorParams::lightSamples,
                  "Shadow rays from each hit to the emissive surfaces, and to the environment.", 1u, 256u)
                .lessNoise()
                .onlyWith(oneOf(&MirrorParams::directAtHits, {MirrorDirect::ShadowRays}))};
    }
};

}  // namespace voxray

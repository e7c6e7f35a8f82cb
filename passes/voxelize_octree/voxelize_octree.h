#pragma once

#include <memory>

#include "passes/common/octree/brick_octree_builder.h"
#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/voxelize_octree/fragment_list.h"

namespace voxray {

/// Voxelization and octree as published in Arnebäck 2017, sections 3.2.1 and 3.2.2: triangles are drawn into
/// a list of fragments, the octree is built over them level by level, and its leaves get the mean color and
/// normal of their fragments. What stays is done once; what moves follows in a section of its own.
class VoxelizeOctree final : public Pass {
 public:
    static constexpr const char* kName = "voxelize_octree";
    static constexpr const char* kHelp =
        "Turns triangles into a list of fragments and these into an octree of bricks, whose leaves hold a "
        "mean color and a mean normal, for light_octree. As published in Arnebäck 2017 (sections 3.2.1 and "
        "3.2.2), for comparison: voxelize and filter_voxels with layout svo are the method to use. Biased "
        "by: voxel size; surfaces whose sides share a voxel, whose normals cancel out; surfaces between "
        "samples, which are missed; 8 bits. Noisy by: nothing, but means of 8 bits depend on the order of "
        "threads by a few steps. Source: Arnebäck 2017, section 3.2.";
    struct Params {
        uint32_t resolution = 128;
        uint32_t samples = 8;
        bool brickNeighbors = true;
        static constexpr auto schema() {
            return std::tuple{
                field("resolution", &Params::resolution,
                      "Voxels along each side of the cube round the scene, which is as wide as the scene's "
                      "longest side.",
                      1u, 1024u),
                field("samples", &Params::samples,
                      "Sample points of a voxel's column that are tested: 8 for multisampling as published "
                      "(how many it does not say), 1 for the column's center alone.",
                      {1u, 8u}),
                field("brick_neighbors", &Params::brickNeighbors,
                      "Whether the 26 neighbours of each node that surfaces pass through are made to exist. "
                      "Off, values that bricks share differ where one is missing (figure 28).")};
        }
    };

    explicit VoxelizeOctree(const Params& params)
        : params_(params), walk_(makeSampledAxisWalk(params.samples)) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// The fragments of some triangles.
    FragmentList voxelize(PassContext& context, const std::vector<uint32_t>& triangles);
    /// Merges fragments into the colors and normals of their leaves.
    void assign(PassContext& context, const FragmentList& fragments);

    Params params_;
    std::unique_ptr<TriangleWalk> walk_;
    Port<BrickOctree> octree_;
    BrickOctreeBuilder builder_;
    Program count_, list_, assign_, mark_;
    std::vector<uint32_t> still_, moving_;  ///< Triangles.
    bool hasStatic_ = false;                ///< Whether the static section is built.
};

}  // namespace voxray

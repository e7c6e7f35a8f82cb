#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "graph/pass.h"
#include "passes/common/triangle_walk/voxel_region.h"

namespace voxray {

/// Visits each pair of a triangle and a voxel that it meets, once. A method finds the pairs; what is done
/// with them is the user's: a visitor, which is GLSL that defines `void visitFragment(TriangleFragment f)`
/// (clipped_fragment.glsl).
///
///     walk.select(context, grid, region, triangles);         which pairs
///     walk.run(context, visitor, grid, bindings, scale);     as often as there are visitors
///     walk.release();                                        once the stream has finished
class TriangleWalk {
 public:
    virtual ~TriangleWalk() = default;
    /// Describes scratch memory for all triangles of the scene. @throws Error naming a feature that the
    /// device lacks.
    virtual void plan(PassPlan&) {}
    /// Makes a visitor for this method, a program of the owner. @param shader its path from "passes/" on
    /// without the extension: `shader`.comp includes triangle_walk/exact.glsl, `shader`.frag
    /// triangle_walk/raster.glsl.
    virtual std::unique_ptr<PassProgram> makeVisitor(ProgramOwner& owner, const std::string& shader,
                                                     const Defines& defines = {}) const = 0;
    /// Chooses what run() visits: `triangles`, those that may have a part in the region. All pairs with
    /// voxels of the region are visited; others may be.
    virtual void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                        const std::vector<uint32_t>& triangles) = 0;
    /// @param bindings of the visitor, besides the scene's. @param visitorScale for the visitor, as
    /// `walk.visitorScale`.
    virtual void run(PassContext& context, const Program& visitor, const gpu::VoxelGrid& grid,
                     std::span<const Binding> bindings, float visitorScale) const = 0;
    /// Frees what select() counted and took, once the stream has finished.
    virtual void release() {}
};

/// Tests triangles against voxels' boxes in a compute shader.
std::unique_ptr<TriangleWalk> makeExactWalk();
/// Rasterises each triangle once, conservatively, along the axis that it faces most.
std::unique_ptr<TriangleWalk> makeDominantAxisWalk();
/// Rasterises each triangle once, along the axis that it faces most, a voxel a pixel: as published in
/// Arnebäck 2017, section 3.2.1. @param samples a pixel: 1, in its center, or 8, the standard pattern of D3D
/// and Vulkan.
std::unique_ptr<TriangleWalk> makeSampledAxisWalk(uint32_t samples);
/// Rasterises along all three axes, `samples` squared points a voxel.
std::unique_ptr<TriangleWalk> makeThreeAxisWalk(uint32_t samples);

}  // namespace voxray

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "graph/pass.h"
#include "passes/common/triangle_voxelizer/voxel_region.h"

namespace voxray {

/// Finds the voxels that triangles overlap. For each pair of a triangle and a voxel it calls a fragment
/// callback once: GLSL that defines `void processFragment(TriangleFragment f)` (clipped_fragment.glsl).
///
///     voxelizer.select(context, grid, region, triangles);
///     voxelizer.run(context, program, grid, bindings, scale);   // once for each callback
///     voxelizer.release();                                      // once the stream has finished
class TriangleVoxelizer {
 public:
    virtual ~TriangleVoxelizer() = default;
    /// Describes scratch memory for all triangles of the scene. @throws Error naming a feature that the
    /// device lacks.
    virtual void plan(PassPlan&) {}
    /// Makes the program that runs a fragment callback. @param shader path of the callback from "passes/" on,
    /// without extension: `shader`.comp includes triangle_voxelizer/exact.glsl, `shader`.frag
    /// triangle_voxelizer/raster.glsl.
    virtual std::unique_ptr<PassProgram> makeProgram(ProgramOwner& owner, const std::string& shader,
                                                     const Defines& defines = {}) const = 0;
    /// Sets what run() voxelizes. @param triangles that may overlap the region. Fragments outside the region
    /// may be processed, too.
    virtual void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                        const std::vector<uint32_t>& triangles) = 0;
    /// @param bindings of the callback, besides the scene's. @param fixedPointScale for the callback, as
    /// `voxelizer.fixedPointScale`.
    virtual void run(PassContext& context, const Program& program, const gpu::VoxelGrid& grid,
                     std::span<const Binding> bindings, float fixedPointScale) const = 0;
    /// Frees what select() allocated, once the stream has finished.
    virtual void release() {}
};

/// Triangle-box overlap tests in a compute shader.
std::unique_ptr<TriangleVoxelizer> makeExactVoxelizer();
/// Rasterization of each triangle along its dominant axis: all voxels that its plane crosses in the columns of
/// voxels whose pixels are drawn. Conservative: shaders grow triangles, so that all that they touch are.
std::unique_ptr<TriangleVoxelizer> makeDominantAxisVoxelizer();
/// The same by the device's conservative rasterization (VK_EXT_conservative_rasterization).
std::unique_ptr<TriangleVoxelizer> makeHardwareConservativeVoxelizer();
/// The same by multisampling: pixels with a sample in the triangle. @param samples per pixel, a power of two.
std::unique_ptr<TriangleVoxelizer> makeMultisampledVoxelizer(uint32_t samples);
/// Rasterization of each triangle along its dominant axis with one voxel per pixel, as published in Arnebäck
/// 2017, section 3.2.1. Fragments are those in voxels from grid.first up to grid.resolution, which may be a
/// part of a level. @param samples per pixel: 1, in its center, or 8, the standard pattern of D3D and Vulkan.
std::unique_ptr<TriangleVoxelizer> makeSampledAxisVoxelizer(uint32_t samples);
/// Rasterization along all three axes, with samples² points per voxel face.
std::unique_ptr<TriangleVoxelizer> makeThreeAxisVoxelizer(uint32_t samples);

}  // namespace voxray

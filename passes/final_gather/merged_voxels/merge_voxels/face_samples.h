#pragma once

#include <array>

#include "passes/common/voxels/voxels.h"
#include "passes/final_gather/merged_voxels/tree_builder.h"

namespace voxray {

/// What the faces of all voxels hold, on the host.
struct VoxelFaces {
    /// Those that know any light: +x -x +y -y +z -z.
    std::array<std::vector<FaceSample>, kFaces> faces;
    std::vector<uint32_t> known;  ///< Which these are: IrradianceTree::faces.
};

/// Reads them back. Errors are relative to the mean irradiance of all faces in the aligned block of 8³ voxels
/// that holds a voxel, since that is about what surfaces near it see, and at least to a thousandth of the
/// mean of all. Waits for the device.
VoxelFaces readVoxelFaces(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelIrradiance& light,
                          bool withDirect);

}  // namespace voxray

#pragma once

#include <array>

#include "passes/common/voxels/voxels.h"
#include "passes/final_gather/merged_voxels/tree_builder.h"

namespace voxray {

/// Irradiance of the faces of all voxels, on the host.
struct VoxelFaces {
    /// Faces with a value, by direction: +x -x +y -y +z -z.
    std::array<std::vector<FaceSample>, kFaces> faces;
    std::vector<uint32_t> faceBits;  ///< IrradianceTree::faces
};

/// Reads the faces back. Errors are relative to the mean irradiance of all faces in the aligned block of 8³
/// voxels around a voxel, about what adjacent surfaces see, but at least to a thousandth of the mean of all
/// faces. Waits for the device.
VoxelFaces readVoxelFaces(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelIrradiance& light,
                          bool withDirect);

}  // namespace voxray

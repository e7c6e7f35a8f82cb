#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// How a color is merged into a voxel's word, numbered as in passes/published/packed_write.glsl.
enum class PackedWrite { MovingAverage, Max, None };
template <>
struct EnumNames<PackedWrite> {
    static constexpr std::array names{std::pair{PackedWrite::MovingAverage, "moving_average"},
                                      std::pair{PackedWrite::Max, "max"}, std::pair{PackedWrite::None, "none"}};
};

/// The parameter of passes that write packed words.
struct PackedWriteParams {
    PackedWrite write = PackedWrite::MovingAverage;
    static constexpr auto schema() {
        return std::tuple{field("write", &PackedWriteParams::write,
                                "How values in a voxel's word are merged, as published in Magalhães 2020. "
                                "moving_average: compare and swap, with the count in alpha (section 4.2.5.3). "
                                "max: an atomic maximum of the packed word, decided by blue (section 5.2.4). "
                                "none: a plain store; which value remains is undefined.")};
    }
    /// Definitions of passes/published/packed_write.glsl.
    Defines defines() const { return {{"PACKED_WRITE", std::to_string(int(write))}}; }
};

/// Volumes of one RGBA8 word per voxel, as published in Magalhães 2020 (section 4.2.1, table 4.1): no faces,
/// no areas, and a word for empty voxels, too, which is 0. Buffers replace the thesis's 3D textures. GLSL
/// access: passes/published/magalhaes_2020/packed_voxels.glsl.
struct PackedVoxels : Resource {
    gpu::VoxelGrid grid{};
    LargeBuffer normals;  ///< Mean of the front-side normals n, as 0.5 n + 0.5.
    LargeBuffer albedos;  ///< Mean diffuse reflectance.

    /// Bytes of one volume.
    uint64_t bytes() const {
        return uint64_t(grid.resolution.x) * grid.resolution.y * grid.resolution.z * sizeof(uint32_t);
    }
};

/// Irradiance in the voxels of PackedVoxels, of all faces in one.
struct PackedLight : Resource {
    std::string indexedBy() const override { return "packed_voxels"; }

    LargeBuffer irradiance;  ///< In units of `white`, clamped.
    float white = 1;         ///< W/m²
};

}  // namespace voxray

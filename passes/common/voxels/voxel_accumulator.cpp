#include "passes/common/voxels/voxel_accumulator.h"

#include "base/error.h"
#include "passes/common/compute/enum_define.h"

namespace voxray {
namespace {

/// As declared in shaders/voxels/voxel_accumulator.glsl.
struct BytesPerVoxel {
    uint64_t sums, weights;
};
BytesPerVoxel bytesPerVoxel(Write write) {
    switch (write) {
        case Write::Average:
            return {kFaces * 3 * sizeof(uint64_t), kFaces * sizeof(uint64_t)};
        case Write::MovingAverage:
            return {kFaces * sizeof(uint32_t), 0};
        case Write::Max:
            return {kFaces * 3 * sizeof(uint32_t), kFaces * sizeof(uint32_t)};
        default:
            return {kFaces * 4 * sizeof(float), 0};
    }
}

}  // namespace

VoxelAccumulator::VoxelAccumulator(ProgramOwner& owner, const WriteParams& params)
    : params_(params), resolve_(owner, "voxel_accumulator_resolve.comp", defines(params.write)) {}

void VoxelAccumulator::plan(const PassPlan& plan, const std::string& pass, const WriteParams& params) {
    if (params.write == Write::Average && !plan.device.shaderInt64Atomics)
        throw Error(
            "{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics), which 'write: "
            "average' needs; choose another 'write'",
            pass, plan.device.name);
}

Defines VoxelAccumulator::defines(Write write) {
    return {{"WRITE", enumDefine("WRITE_", write)}};
}

void VoxelAccumulator::begin(Device& device, CommandStream& stream, const VoxelLevels& voxels,
                             float typicalIrradiance) {
    const BytesPerVoxel bytes = bytesPerVoxel(params_.write);
    const auto clear = [&](LargeBuffer& buffer, const char* name, uint64_t size) {
        ensureSize(buffer, device, name, size);
        stream.fill(buffer, 0);
    };
    clear(sums_, "voxel irradiance sums", voxels.voxelCount * bytes.sums);
    if (bytes.weights > 0) clear(weights_, "voxel irradiance weights", voxels.voxelCount * bytes.weights);
    scale_ = 1;
    if (params_.write == Write::Average && typicalIrradiance > 0) scale_ = float(1u << 24) / typicalIrradiance;
    if (params_.write == Write::MovingAverage) scale_ = 1 / params_.white;
}

std::vector<Binding> VoxelAccumulator::bindings() const {
    std::vector<Binding> list{{"VoxelSumsRef", sums_.ref()}};
    if (weights_) list.push_back({"VoxelWeightsRef", weights_.ref()});
    return list;
}

void VoxelAccumulator::resolve(CommandStream& stream, const SurfaceVoxels& voxels, const LargeBuffer& flux,
                               const Buffer& area) const {
    stream.dispatch(resolve_, voxels.voxelCount,
                    {*this,
                     {"VoxelMaterialsRef", voxels.materials.ref()},
                     {"FluxRef", flux.ref()},
                     {"area", area},
                     {"voxelCount", voxels.voxelCount},
                     {"voxelSize", voxels.grid.voxelSize},
                     {"scale", scale_}});
}

}  // namespace voxray

#include "passes/merge_voxels/merge_voxels.h"

#include <cmath>
#include <span>

#include "base/parallel.h"
#include "passes/merge_voxels/face_samples.h"

namespace voxray {
namespace {

/// The buffer `irradianceTree` of shaders/irradiance_tree/irradiance_tree.glsl.
struct Header {
    VkDeviceAddress words;
    gpu::IrradianceTreeGrid grid;
};

/// Of a tree with a leaf for each face of each voxel: leaves, and splits.
uint64_t maxBytes(uint32_t voxelCount) {
    return uint64_t(voxelCount) * kFaces * (TREE_LEAF_WORDS + 1) * sizeof(uint32_t);
}

}  // namespace

void MergeVoxels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    tree_ = builder.write<IrradianceTree>("irradiance_tree", "the same light, voxels that are alike merged");
}

void MergeVoxels::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    plan.get(tree_).lightBounces = plan.get(irradiance_).lightBounces;
    plan.get(tree_).holdsDirect = params_.light == MergedLight::All;
    plan.buffer(plan.get(tree_).header, "header of the irradiance tree", sizeof(Header));
    plan.reserve("irradiance tree (at most)", maxBytes(voxels.voxelCount));
    plan.reserve("occupancy and known faces", 2 * voxels.words() * sizeof(uint32_t) + voxels.voxelCount + 4);
}

void MergeVoxels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& light = context.get(irradiance_);
    IrradianceTree& tree = context.get(tree_);
    const std::pair version{voxels.version, light.version};
    if (version_ == version) return;
    version_ = version;

    // A tree for each face
    VoxelFaces all = readVoxelFaces(context.stream, voxels, light, tree.holdsDirect);
    std::array<SampleTree, kFaces> trees;
    parallelRanges(kFaces, 1, [&](size_t begin, size_t end) {
        for (size_t face = begin; face < end; ++face)
            trees[face] = buildSampleTree(all.faces[face], params_.tolerance);
    });

    // One after another
    Header header{0, {voxels.grid, {}}};
    std::vector<uint32_t> words;
    double area = 0, squaredError = 0;
    size_t count = 0;
    tree.leaves = 0;
    for (size_t face = 0; face < kFaces; ++face) {
        header.grid.root[face] = uint32_t(words.size());
        words.insert(words.end(), trees[face].words.begin(), trees[face].words.end());
        tree.leaves += trees[face].leaves;
        squaredError += trees[face].squaredError;
        for (const FaceSample& s : all.faces[face]) area += s.area;
        count += all.faces[face].size();
    }
    tree.words = {};
    tree.words = Buffer(context.device, "irradiance tree", words.size() * sizeof(uint32_t));
    context.stream.upload(tree.words, words);
    header.words = tree.words.address();
    context.stream.upload(tree.header, std::as_bytes(std::span(&header, 1)));

    // The voxels that they are for
    const auto copied = [&](const Buffer& from, const char* name) {
        Buffer copy(context.device, name, from.bytes());
        context.stream.copy(from, copy, from.bytes());
        return copy;
    };
    tree.occupancy = {};
    tree.rank = {};
    tree.faces = {};
    tree.occupancy = copied(voxels.occupancy, "occupancy of merged voxels");
    tree.rank = copied(voxels.rank, "rank of merged voxels");
    tree.faces = Buffer(context.device, "faces of merged voxels", all.known.size() * sizeof(uint32_t));
    context.stream.upload(tree.faces, all.known);
    context.stream.finish();
    context.report("faces of voxels", double(count));
    context.report("leaves", tree.leaves);
    context.report("bytes of the trees", double(tree.words.bytes()));
    context.report("bytes in all", double(tree.bytes()));
    context.report("relative error of faces", area > 0 ? std::sqrt(squaredError / area) : 0);
}

}  // namespace voxray

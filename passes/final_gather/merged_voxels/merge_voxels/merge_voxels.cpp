#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "graph/registry.h"
#include "passes/common/voxels/voxels.h"
#include "passes/final_gather/merged_voxels/irradiance_tree.h"
#include "passes/final_gather/merged_voxels/merge_voxels/face_samples.h"

namespace voxray {
namespace {

/// As in irradiance_tree.glsl.
struct Header {
    VkDeviceAddress words;
    gpu::IrradianceTreeGrid grid;
};

}  // namespace

enum class MergedLight { All, Indirect };
template <>
struct EnumNames<MergedLight> {
    static constexpr std::array names{std::pair{MergedLight::All, "all"}, std::pair{MergedLight::Indirect, "indirect"}};
};

/// Merges voxels of similar irradiance, so that the resolution follows the error.
class MergeVoxels final : public Pass {
 public:
    static constexpr const char* kName = "merge_voxels";
    static constexpr const char* kHelp =
        "Merges adjacent voxels of similar irradiance into k-d trees. "
        "There is a tree for each of the six face directions, whose leaves are merged voxels, for gather_rays. "
        "Trees are built down to single voxels, then leaves that reduce the error too little are pruned. "
        "Runs on the host. Biased by: tolerance; flux is preserved. Source: cost-complexity pruning (Breiman et al. "
        "1984; Chou, Lookabaugh and Gray 1989).";
    struct Params {
        float tolerance = 0.3f;
        MergedLight light = MergedLight::All;
        static constexpr auto schema() {
            return std::tuple{
                field("tolerance", &Params::tolerance,
                      "Relative error of irradiance that is accepted over the area of one voxel face. "
                      "A leaf is pruned where it reduces the squared relative error times area, in voxel faces, "
                      "by less than this squared. 0: only equal values are merged. Black is merged with black only.",
                      0.0f, 30.0f),
                field("light", &Params::light,
                      "all: direct and indirect light. "
                      "indirect: indirect light only; gather_rays measures direct light at each hit.")};
        }
    };

    explicit MergeVoxels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    Out<IrradianceTree> tree_{*this, "irradiance_tree", "light of merged voxels"};
};

void MergeVoxels::plan(PassPlan& plan) {
    IrradianceTree& tree = plan[tree_];
    tree.lightBounces = plan[irradiance_].lightBounces;
    tree.holdsDirect = params_.light == MergedLight::All;
    const uint64_t bitBytes = plan[voxels_].words() * sizeof(uint32_t);
    plan.buffer(tree.header, "header of the irradiance tree", sizeof(Header));
    plan.buffer(tree.occupancy, "occupancy of merged voxels", bitBytes);
    plan.buffer(tree.rank, "rank of merged voxels", bitBytes);
}

void MergeVoxels::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const VoxelIrradiance& light = context[irradiance_];
    IrradianceTree& tree = context[tree_];

    // Build the trees
    VoxelFaces voxelFaces = readVoxelFaces(context.stream, voxels, light, tree.holdsDirect);
    std::array<SampleTree, kFaces> trees;
    parallelRanges(kFaces, 1, [&](size_t begin, size_t end) {
        for (size_t face = begin; face < end; ++face)
            trees[face] = buildSampleTree(voxelFaces.faces[face], params_.tolerance);
    });

    // Concatenate them
    Header header{0, {voxels.grid, {}}};
    std::vector<uint32_t> words;
    double area = 0, squaredError = 0;
    size_t count = 0;
    uint32_t leaves = 0;
    for (size_t face = 0; face < kFaces; ++face) {
        header.grid.root[face] = uint32_t(words.size());
        words.insert(words.end(), trees[face].words.begin(), trees[face].words.end());
        leaves += trees[face].leaves;
        squaredError += trees[face].squaredError;
        for (const FaceSample& s : voxelFaces.faces[face]) area += s.area;
        count += voxelFaces.faces[face].size();
    }
    tree.words = {};
    tree.words = Buffer(context.device, "irradiance tree", words.size() * sizeof(uint32_t));
    context.stream.upload(tree.words, words);
    header.words = tree.words.address();
    context.stream.upload(tree.header, std::as_bytes(std::span(&header, 1)));

    // Copy the voxels' occupancy
    context.stream.copy(voxels.occupancy, tree.occupancy, tree.occupancy.bytes());
    context.stream.copy(voxels.rank, tree.rank, tree.rank.bytes());
    tree.faces = {};
    tree.faces = Buffer(context.device, "faces of merged voxels", voxelFaces.faceBits.size() * sizeof(uint32_t));
    context.stream.upload(tree.faces, voxelFaces.faceBits);
    context.stream.finish();
    context.report("faces of voxels", double(count));
    context.report("leaves", leaves);
    context.report("bytes of the trees", double(tree.words.bytes()));
    context.report("bytes in all", double(tree.bytes()));
    context.report("relative error of faces", area > 0 ? std::sqrt(squaredError / area) : 0);
}

VOXRAY_REGISTER_PASS(MergeVoxels);

}  // namespace voxray

#include "passes/build_hybrid_leaves/build_hybrid_leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "passes/build_hybrid_leaves/leaf_counts.h"
#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

/// The buffer `hybridLeaves` of shaders/hybrid_leaves/hybrid_leaves.glsl.
struct Header {
    VkDeviceAddress words, primitives;
    gpu::HybridShape shape;
};

struct LeavesPush {
    uint32_t leaves;
    uint32_t capacity;
};

constexpr uint64_t kMaxWords = 1ull << 31;  // shaders/hybrid_leaves/hybrid_types.h

uint64_t wordBytes(uint64_t count) {
    return std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

}  // namespace

void BuildHybridLeaves::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels: the leaves");
    leaves_ = builder.write<HybridLeaves>("hybrid_leaves", "what each leaf holds");
}

void BuildHybridLeaves::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    if (voxels.grid.side <
        std::max({voxels.grid.resolution.x, voxels.grid.resolution.y, voxels.grid.resolution.z}))
        throw Error(
            "build_hybrid_leaves: leaves are those of all voxels, of which this grid holds a window; take "
            "voxelize");
    const Geometry& geometry = plan.frame.scene->geometry;
    const std::vector<uint32_t> counts =
        plan.ofScene(fmt::format("triangles of leaves {}", voxels.grid.voxelSize),
                     [&] { return countLeafTriangles(geometry, voxels.grid); });
    const uint64_t words = std::reduce(counts.begin(), counts.end(), uint64_t(0));
    if (words >= kMaxWords)
        throw Error(
            "build_hybrid_leaves: lists hold at most {} triangles' numbers; these are {}: lower voxelize's "
            "'resolution' or 'primitives'",
            kMaxWords, words);
    plan.buffer(plan.get(leaves_).header, "hybrid leaves' header", sizeof(Header));
    plan.reserve("hybrid leaves (estimated)", wordBytes(voxels.voxelCount));
    plan.reserve("lists of triangles (at most)", wordBytes(words));
    plan.reserveScratch("triangles of each leaf (estimated)",
                        2 * wordBytes(voxels.voxelCount) + PrefixSum::scratchBytes(voxels.voxelCount));
    walk_->plan(plan, voxels.grid);
}

void BuildHybridLeaves::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    walk_->prepare(setup);
    count_ = walk_->compileVisitor(setup, "passes/build_hybrid_leaves/count_triangles");
    fill_ = walk_->compileVisitor(setup, "passes/build_hybrid_leaves/fill_lists");
    size_ = program("passes/build_hybrid_leaves/size_lists.comp");
    number_ = program("passes/build_hybrid_leaves/number_leaves.comp");
    sort_ = program("passes/build_hybrid_leaves/sort_lists.comp");
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
    version_.reset();
}

void BuildHybridLeaves::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    if (version_ == voxels.version) return;
    version_ = voxels.version;
    HybridLeaves& leaves = context.get(leaves_);
    CommandStream& stream = context.stream;
    const LeavesPush push{voxels.voxelCount, params_.primitives};
    const glm::uvec3 groups = linearGroups(push.leaves);
    const VoxelRegion all(voxels.grid);
    walk_->select(context, voxels.grid, all, all.triangles(context.frame.scene->geometry));

    // How many triangles each leaf has, and where its list begins: an exclusive sum (Seok 2021, figure 7,
    // without its order of arrival).
    Buffer counts(context.device, "triangles of each leaf", wordBytes(push.leaves));
    const Buffer sizes(context.device, "sizes of lists", wordBytes(push.leaves));
    stream.fill(counts, 0);
    walk_->run(context, count_, voxels.grid, voxels.bindings({{"counts", counts}}), 0);
    const Buffer over(context.device, "leaves over the capacity", sizeof(uint32_t));
    stream.fill(over, 0);
    stream.dispatch(size_, {{"counts", counts}, {"sizes", sizes}, {"over", over}}, push, groups);
    if (const uint32_t full = stream.readAs<uint32_t>(over, 1)[0]; full > 0)
        throw Error("build_hybrid_leaves: {} leaves hold more than {} triangles: raise 'primitives'", full,
                    params_.primitives);
    leaves.words = {};
    leaves.words = Buffer(context.device, "hybrid leaves", wordBytes(push.leaves));
    leaves.primitiveCount = prefixSum_->run(stream, sizes, leaves.words, push.leaves);
    stream.dispatch(number_, {{"counts", counts}, {"words", leaves.words}}, push, groups);

    leaves.primitives = {};
    leaves.primitives = Buffer(context.device, "lists of triangles", wordBytes(leaves.primitiveCount));
    leaves.shape = {push.leaves, push.capacity, 0, 0};
    const Header header{leaves.words.address(), leaves.primitives.address(), leaves.shape};
    stream.upload(leaves.header, std::as_bytes(std::span(&header, 1)));

    // The lists, in ascending order whatever the order of arrival (Seok 2021, figure 8)
    std::vector<Binding> bindings = voxels.bindings({{"sizes", sizes}});
    bindings.push_back({"hybridLeaves", leaves.header});
    walk_->run(context, fill_, voxels.grid, bindings, 0);
    stream.dispatch(sort_, {{"counts", counts}, {"hybridLeaves", leaves.header}}, push, groups);
    stream.finish();
    walk_->release();
    ++leaves.version;
    context.report("triangles in lists", leaves.primitiveCount);
}

}  // namespace voxray

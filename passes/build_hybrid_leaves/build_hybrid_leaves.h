#pragma once

#include <memory>
#include <optional>
#include <tuple>

#include "graph/registry.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/hybrid_leaves/hybrid_leaves.h"
#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Fills the leaves of the octree over surface voxels with lists of triangles.
class BuildHybridLeaves final : public Pass {
 public:
    static constexpr const char* kName = "build_hybrid_leaves";
    static constexpr const char* kHelp =
        "Gives each leaf of the octree over surface voxels the list of the triangles in it, for rays that "
        "meet triangles where they are few. "
        "Exact: no bias, no noise. Source: Seok 2021, chapter 3.";
    struct Params {
        uint32_t primitives = 64;
        static constexpr auto schema() {
            return std::tuple{field("primitives", &Params::primitives,
                                    "Capacity p of a leaf: its list holds at most as many triangles "
                                    "(Seok 2021, section 3.2).",
                                    1u, 1u << 20)};
        }
    };

    explicit BuildHybridLeaves(const Params& params) : params_(params), walk_(makeExactWalk()) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<HybridLeaves> leaves_;
    std::unique_ptr<TriangleWalk> walk_;
    Program count_, size_, number_, fill_, sort_;
    std::optional<PrefixSum> prefixSum_;
    std::optional<uint64_t> version_;  ///< Of the voxels that it is built over.
};

}  // namespace voxray

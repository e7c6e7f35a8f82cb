#pragma once

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Counts what one voxelization misses of another and adds to it.
class CompareVoxels final : public Pass {
 public:
    static constexpr const char* kName = "compare_voxels";
    static constexpr const char* kHelp =
        "Counts the voxels of 'truth' that 'voxels' misses, and those that it adds, and compares their "
        "surface "
        "areas: into values.csv and the report. Writes nothing that others read. Exact. Both need the same "
        "grid: the same 'resolution'. Source: Schwarz and Seidel 2010, section 4, for 'method: exact' as the "
        "truth.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit CompareVoxels(const Params&) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup&) override {}
    void record(PassContext& context) override;

 private:
    Port<const SurfaceVoxels> truth_, voxels_;
};

}  // namespace voxray

#pragma once

#include <array>

#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/view/surface_motion.h"
#include "passes/final_gather/gather_screen_probes/screen_probe_types.h"

namespace voxray {

/// The probes of a frame and, where rays are guided, those of the frame before: places on what the camera sees, one
/// in each tile of the G-buffer and some more where a tile shows several surfaces.
class ScreenProbes {
 public:
    struct Settings {
        uint32_t spacing = 8;      ///< Pixels along a tile's edge.
        uint32_t extraProbes = 0;  ///< Most probes of a tile besides the first.
        bool keepsLast = false;    ///< Whether the previous frame's probes are kept.
    };
    ScreenProbes(ProgramOwner& owner, const Settings& settings);

    /// @param samples GBuffer::samples.
    void plan(PassPlan& plan, uint32_t samples);
    /// Places and lists the probes of a frame. Waits for the device. @param motion null where no history is kept.
    void place(PassContext& context, const GBuffer& gbuffer, const SurfaceMotion* motion);

    const gpu::ProbeTiles& tiles() const { return tiles_; }
    uint32_t tileCount() const { return tiles_.tiles.x * tiles_.tiles.y; }
    uint32_t capacity() const { return tileCount() * slotsPerTile(); }
    uint32_t count() const { return count_; }
    /// Probes for which buffers that last are made: `count()` rounded up to quarters of the tiles, so that they seldom
    /// have to grow.
    uint32_t reservedCount() const;
    /// Whether there are probes of a previous frame.
    bool hasLast() const { return hasLast_; }
    /// `probes`, `firstProbes` and `tiles`, and of the previous frame `oldProbes` and `oldFirstProbes`.
    std::vector<Binding> bindings() const;

 private:
    uint32_t slotsPerTile() const { return 1 + settings_.extraProbes; }

    const Settings settings_;
    Kernel place_, placeExtra_, list_;
    PrefixSum sum_;
    gpu::ProbeTiles tiles_{};
    uint32_t count_ = 0, current_ = 1;
    bool hasLast_ = false;
    Buffer slots_, counts_, extraCounts_;
    std::array<Buffer, 2> probes_, firstProbes_;  ///< This frame's and the previous one's; they change places.
};

}  // namespace voxray

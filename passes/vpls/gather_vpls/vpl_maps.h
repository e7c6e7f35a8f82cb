#pragma once

#include "graph/pass.h"
#include "passes/vpls/vpls.h"

namespace voxray {

/// Shadow maps of virtual point lights, of a run of them at a time: what the hemisphere of each sees, an
/// octahedron's upper half unfolded (hemisphere.glsl).
class VplMaps {
 public:
    static constexpr uint32_t kTexels = 1u << 20;  ///< Of all maps at a time, which bounds the memory.

    /// @param resolution texels a side of each map.
    explicit VplMaps(uint32_t resolution) : resolution_(resolution) {}
    virtual ~VplMaps() = default;

    virtual void plan(PassPlan& plan) = 0;
    /// Before the first draw() of a frame.
    virtual void begin(PassContext& context) = 0;
    /// Makes the maps of virtual lights [first, first + count) of the list, capacity() at most.
    virtual void draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const = 0;

    /// For map_shadows.comp, which reads the maps.
    virtual Defines defines() const = 0;
    virtual Binding binding() const = 0;

    uint32_t resolution() const { return resolution_; }
    uint32_t capacity() const { return kTexels / (resolution_ * resolution_); }

 private:
    uint32_t resolution_;
};

}  // namespace voxray

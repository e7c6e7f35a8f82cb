#pragma once

#include "graph/pass.h"
#include "passes/vpls/vpls.h"

namespace voxray {

/// Shadow maps of virtual point lights, for a range of the lights at a time.
class VplShadowMaps {
 public:
    static constexpr uint32_t kTexels = 1u << 20;  ///< Of all maps of a range: bounds the memory.

    /// @param resolution texels along an edge of each map. @param capacity maps of a range.
    VplShadowMaps(uint32_t resolution, uint32_t capacity) : resolution_(resolution), capacity_(capacity) {}
    virtual ~VplShadowMaps() = default;

    virtual void plan(PassPlan& plan) = 0;
    /// Called before the first render() of a frame.
    virtual void beginFrame(PassContext& context, const Vpls& vpls) = 0;
    /// Renders the maps of active lights [first, first + count), at most capacity().
    virtual void render(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const = 0;

    /// Definitions and buffers of test_shadow_maps.comp.
    virtual Defines defines() const = 0;
    virtual std::vector<Binding> bindings() const = 0;

    uint32_t resolution() const { return resolution_; }
    uint32_t capacity() const { return capacity_; }

 private:
    uint32_t resolution_, capacity_;
};

}  // namespace voxray

#pragma once

#include "passes/cones/filter_voxels/radiance_storage.h"

namespace voxray {

/// Storage in full grids, filled level by level, for any layout whose shader defines what
/// docs/writing-a-pass.md lists.
class FullGrids : public RadianceStorage {
 public:
    explicit FullGrids(ProgramOwner& owner)
        : surface_(owner, "dense_surface.comp"), level_(owner, "passes/cones/radiance/filter_level.comp") {}
    void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light, RadianceVoxels& radiance,
             float emission) override;

 protected:
    /// Compiles the shaders for the layout of `radiance`.
    void define(const RadianceVoxels& radiance);

 private:
    Kernel surface_, level_;
};

}  // namespace voxray

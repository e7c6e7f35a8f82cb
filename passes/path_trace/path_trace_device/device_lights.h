#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/path_trace/path_trace_device/path_types.h"

namespace voxray {

/// The host's LightTable on the device, for path_lights.glsl: which light is drawn how often, and where emissive
/// patches are.
class DeviceLights {
 public:
    void plan(PassPlan& plan);
    /// Uploads the frame's lights if they changed.
    void update(PassContext& context);

    /// For shaders that include path_lights.glsl; `trianglePatches` is the address of a uint a triangle.
    std::vector<Binding> bindings() const {
        return {{"lightBins", bins_},
                {"lightPatches", patches_},
                {"lights", lights_},
                {"trianglePatches", uint64_t(trianglePatches_.address())}};
    }

 private:
    gpu::PathLights lights_{};
    Buffer bins_, patches_, trianglePatches_;
    std::optional<uint64_t> sceneVersion_;  ///< Of the uploaded lights.
};

}  // namespace voxray

#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/path_trace/path_streams/path_types.h"

namespace voxray {

/// The host's LightTable on the device, for path_lights.glsl: the light tree, where emissive patches
/// are, and which triangles are simple (path_types.h).
class DeviceLights {
 public:
    void plan(PassPlan& plan);
    /// Uploads the frame's lights if they changed.
    void update(PassContext& context);

    /// For shaders that include path_lights.glsl; `triangleFacts` is the address of a uint a triangle.
    std::vector<Binding> bindings() const {
        return {{"pathLightTree", tree_},
                {"infiniteLights", infinite_},
                {"lightPatches", patches_},
                {"lights", lights_},
                {"triangleFacts", uint64_t(triangleFacts_.address())}};
    }

 private:
    gpu::PathLights lights_{};
    Buffer tree_, infinite_, patches_, triangleFacts_;
    std::optional<uint64_t> sceneVersion_;  ///< Of the uploaded lights.
};

}  // namespace voxray

#pragma once

#include "passes/path_trace/path_tracer.h"

namespace voxray {

/// A small image of what a camera sees: `spp` paths a pixel, of up to `bounces` bounces. 3 channels,
/// W/(m² sr).
inline ImageF pathTracedPreview(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                                uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces) {
    const PathTraceOptions options{
        .width = width, .height = height, .spp = spp, .bounces = bounces, .rays = ExpectedRays::Few};
    return pathTrace(state, tracer, camera, options).total;
}

}  // namespace voxray

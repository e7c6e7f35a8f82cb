#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "scene/load.h"
#include "tests/support/places.h"
#include "trace/gpu_scene.h"
#include "trace/ray_tracer.h"

namespace voxray::test {

/// A device of the test's own, with the validation layer on, and a Cornell box that Embree traces.
class OnDevice : public testing::Test {
 protected:
    Device device_{{.name = "", .validation = true}};
    ShaderCompiler compiler_{sourceRoot(), {}};
    CommandStream stream_{device_};
    const SceneState state_ = evaluate(makeBuiltinScene("cornell", Value()), 0.0);
    const GpuScene scene_ = makeGpuScene(device_, stream_, state_);
    const std::unique_ptr<RayTracer> tracer_ = makeRayTracer(TracerKind::Embree, device_, compiler_, state_);
};

}  // namespace voxray::test

#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "trace/ray_tracer.h"

namespace voxray {

/// The ray tracers that a device has. Lavapipe has all from Mesa 25 on: with fewer, a test of their parity
/// would pass without having compared them, so it fails.
inline std::vector<TracerKind> tracerKinds(const Device& device) {
    std::vector<TracerKind> kinds{TracerKind::Embree};
    if (device.info().rayQuery) kinds.push_back(TracerKind::RayQuery);
    if (device.info().rayPipeline) kinds.push_back(TracerKind::RayPipeline);
    if (device.info().driver.find("llvmpipe") != std::string::npos) {
        EXPECT_EQ(kinds.size(), 3u) << "lavapipe without ray queries or ray pipelines: install Mesa 25 or later";
    }
    return kinds;
}

}  // namespace voxray

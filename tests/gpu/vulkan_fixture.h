#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/device.h"
#include "tests/support/errors.h"
#include "tests/support/places.h"
#include "vulkan/commands.h"

namespace voxray {

/// Tests of one device with validation; any message fails the test that caused it.
class VulkanTest : public testing::Test {
 protected:
    static Device& device() { return test::device(); }
    static ShaderCompiler compiler() { return ShaderCompiler(test::sourceRoot(), {}); }
    static Program computeProgram(const std::string& file, const Defines& defines = {},
                                  const SpecializationConstants& constants = {}) {
        return makeComputeProgram(device(), *compiler().compile("tests/gpu/" + file, defines), constants);
    }
};

}  // namespace voxray

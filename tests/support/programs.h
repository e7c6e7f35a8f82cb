#pragma once

#include "tests/support/device.h"
#include "tests/support/places.h"
#include "vulkan/kernel.h"

namespace voxray::test {

/// Owns programs that a test runs outside of a pass, on device().
struct TestPrograms : ProgramOwner {
    /// Those that are used and not compiled yet. @throws Error as voxray::compile().
    void compile() { voxray::compile(programs(), device(), ShaderCompiler(sourceRoot(), shaderCache())); }
};

}  // namespace voxray::test

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "vulkan/commands.h"

namespace voxray {

/// A device with validation, shared by the tests of one program; any message fails the test that caused it.
class VulkanTest : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        if (!device_) device_ = new Device(DeviceOptions{.name = {}, .validation = true});
    }
    static void TearDownTestSuite() {
        delete device_;
        device_ = nullptr;
    }
    void SetUp() override { messagesBefore_ = device().validationMessages().size(); }
    void TearDown() override {
        const std::vector<std::string> messages = device().validationMessages();
        for (size_t i = messagesBefore_; i < messages.size(); ++i) ADD_FAILURE() << messages[i];
    }

    static Device& device() { return *device_; }
    static ShaderCompiler compiler() { return ShaderCompiler(VOXRAY_SOURCE_DIR, {}); }
    static Program computeProgram(const std::string& file, const Defines& defines = {},
                                  const SpecializationConstants& constants = {}) {
        return makeComputeProgram(device(), compiler().compile("tests/gpu/" + file, defines), constants);
    }

 private:
    static inline Device* device_ = nullptr;
    size_t messagesBefore_ = 0;
};

/// The text of the Error that `body` throws; a failure and "" where it throws none.
template <typename Body>
std::string errorOf(const Body& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "expected an Error";
    return {};
}

/// Fails unless `text` holds `part`.
inline void expectContains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

}  // namespace voxray

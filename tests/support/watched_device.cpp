#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/device.h"
#include "tests/support/kept.h"

namespace voxray::test {
namespace {

/// Owns the device and fails each test by the messages of the validation layer that came while it ran. The
/// device ends with the last test: once main() has returned, the layer may be gone.
class ValidationListener final : public testing::EmptyTestEventListener {
 public:
    Device& device() { return *device_; }
    void OnTestEnd(const testing::TestInfo&) override {
        const std::vector<std::string> messages = device_->validationMessages();
        for (; seen_ < messages.size(); ++seen_) ADD_FAILURE() << "Vulkan validation: " << messages[seen_];
    }
    void OnTestProgramEnd(const testing::UnitTest&) override {
        kept_.clear();
        device_.reset();
    }
    void keep(std::shared_ptr<void> object) { kept_.push_back(std::move(object)); }

 private:
    std::unique_ptr<Device> device_ = std::make_unique<Device>(DeviceOptions{"", true});
    std::vector<std::shared_ptr<void>> kept_;
    size_t seen_ = 0;
};

ValidationListener& listener() {
    static ValidationListener& shared = []() -> ValidationListener& {
        auto* made = new ValidationListener;  // GoogleTest's from here on
        testing::UnitTest::GetInstance()->listeners().Append(made);
        return *made;
    }();
    return shared;
}

}  // namespace

Device& device() {
    return listener().device();
}

void keep(std::shared_ptr<void> object) {
    listener().keep(std::move(object));
}

}  // namespace voxray::test

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/device.h"

namespace voxray::test {
namespace {

/// Fails each test by the messages of the validation layer that came while it ran.
class ValidationListener final : public testing::EmptyTestEventListener {
 public:
    explicit ValidationListener(const Device& device) : device_(device) {}
    void OnTestEnd(const testing::TestInfo&) override {
        const std::vector<std::string> messages = device_.validationMessages();
        for (; seen_ < messages.size(); ++seen_) ADD_FAILURE() << "Vulkan validation: " << messages[seen_];
    }

 private:
    const Device& device_;
    size_t seen_ = 0;
};

}  // namespace

Device& device() {
    static Device shared({"", true});
    [[maybe_unused]] static const bool isWatched = [] {
        testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener(shared));
        return true;
    }();
    return shared;
}

}  // namespace voxray::test

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "base/error.h"

/// What tests say about errors.
namespace voxray {

/// The message of the E that `body` throws. Where it throws none, the test fails and the answer is "".
template <typename E = Error, typename Body>
std::string errorOf(const Body& body) {
    try {
        body();
    } catch (const E& error) {
        return error.what();
    }
    ADD_FAILURE() << "expected an error";
    return {};
}

inline testing::AssertionResult contains(std::string_view text, std::string_view part) {
    if (text.find(part) != std::string_view::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

}  // namespace voxray

/// Fails unless a statement throws an Error whose message holds `part`.
#define EXPECT_ERROR(part, ...) EXPECT_CONTAINS(::voxray::errorOf([&] { __VA_ARGS__; }), part)

/// Fails unless `text` holds `part`.
#define EXPECT_CONTAINS(text, part) EXPECT_TRUE(::voxray::contains(text, part))

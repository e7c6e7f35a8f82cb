#pragma once

#include "vulkan/device.h"

namespace voxray::test {

/// The one device of a program: opening one takes longer than most tests. In tests it has validation on and
/// fails each test by the messages that come while it runs (watched_device.cpp); in benchmarks it has not
/// (bench/device.cpp).
Device& device();

}  // namespace voxray::test

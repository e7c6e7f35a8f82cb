#pragma once

#include <memory>

namespace voxray::test {

/// Keeps an object of test::device() until the last test has ended (watched_device.cpp): a static one would
/// outlive the device.
void keep(std::shared_ptr<void> object);

template <typename T>
T* kept(const std::shared_ptr<T>& object) {
    keep(object);
    return object.get();
}

}  // namespace voxray::test

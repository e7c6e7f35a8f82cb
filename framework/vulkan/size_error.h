#pragma once

#include "base/error.h"

namespace voxray {

/// A buffer or an image is too large for the device or for its free memory.
class SizeError : public Error {
 public:
    using Error::Error;
};

}  // namespace voxray

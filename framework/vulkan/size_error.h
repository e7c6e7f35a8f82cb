#pragma once

#include "base/error.h"

namespace voxray {

/// A buffer or an image that is too large for a device, or for what is left of its memory.
class SizeError : public Error {
 public:
    using Error::Error;
};

}  // namespace voxray

#pragma once

#include <array>

#include "graph/pass.h"
#include "image/sample_sums.h"

namespace voxray {

/// What the pass of a reference writes: sums over the part of its samples that Frame::samples asks for, on
/// the host. The two halves of all samples are independent of each other.
struct ReferenceSums : Resource {
    std::array<SampleSums, 2> final, indirect;
};

}  // namespace voxray

#pragma once

#include <array>

#include "graph/pass.h"
#include "image/sample_sums.h"

namespace voxray {

/// Output of the reference's pass, on the host: sums over the samples of Frame::samples, in two independent
/// halves.
struct ReferenceSums : Resource {
    std::array<SampleSums, 2> final, indirect;
};

}  // namespace voxray

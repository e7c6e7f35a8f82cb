#include "passes/path_trace/sampling.h"

#include <numeric>

namespace voxray::path_trace {

AliasTable::AliasTable(std::span<const double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0.0)) return;
    const size_t count = weights.size();
    bins_.resize(count);

    // Sort the entries into those below and above the mean.
    std::vector<double> scaled(count);
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < count; ++i) {
        scaled[i] = weights[i] / sum * double(count);
        bins_[i] = {1.0f, i, float(weights[i] / sum)};
        (scaled[i] < 1.0 ? small : large).push_back(i);
    }

    // Fill each small entry's bin up with a part of a large one.
    while (!small.empty() && !large.empty()) {
        const uint32_t s = small.back(), l = large.back();
        small.pop_back();
        bins_[s].threshold = float(scaled[s]);
        bins_[s].alias = l;
        scaled[l] -= 1.0 - scaled[s];
        if (scaled[l] < 1.0) {
            large.pop_back();
            small.push_back(l);
        }
    }
}

}  // namespace voxray::path_trace

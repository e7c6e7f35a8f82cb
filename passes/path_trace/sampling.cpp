#include "passes/path_trace/sampling.h"

#include <numeric>

namespace voxray::path_trace {

AliasTable::AliasTable(std::span<const double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0.0)) return;
    const size_t count = weights.size();
    bins_.resize(count);

    // Divide entries into those below and above the mean
    std::vector<double> relative(count);
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < count; ++i) {
        relative[i] = weights[i] / sum * double(count);
        bins_[i] = {1.0f, i, float(weights[i] / sum)};
        (relative[i] < 1.0 ? small : large).push_back(i);
    }

    // Fill the rest of each small entry's bin from a large entry
    while (!small.empty() && !large.empty()) {
        const uint32_t s = small.back(), l = large.back();
        small.pop_back();
        bins_[s].threshold = float(relative[s]);
        bins_[s].alias = l;
        relative[l] -= 1.0 - relative[s];
        if (relative[l] < 1.0) {
            large.pop_back();
            small.push_back(l);
        }
    }
}

}  // namespace voxray::path_trace

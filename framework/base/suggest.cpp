#include "base/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/lower_case.h"

namespace voxray {
namespace {

// Optimal string alignment distance: insertions, deletions, substitutions, transpositions.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t substitution = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, substitution});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
    const std::string lowerWord = lowerCase(std::string(word));
    std::string best;
    size_t bestDistance = std::max<size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        if (candidate == word) continue;  // Valid elsewhere.
        const size_t distance = editDistance(lowerWord, lowerCase(candidate));
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    if (!best.empty() || word.empty()) return best;

    // A component or prefix: `rays` of `rays_per_block`, `pos` of `position`
    constexpr size_t kMinPrefix = 3;
    const auto isComponent = [&](const std::string& candidate) {
        return fmt::format("_{}_", candidate).find(fmt::format("_{}_", word)) != std::string::npos ||
               (word.size() >= kMinPrefix && candidate.starts_with(word));
    };
    const auto found = std::ranges::find_if(candidates, isComponent);
    return found == candidates.end() ? std::string() : *found;
}

std::string didYouMeanFile(const std::filesystem::path& name, const std::filesystem::path& folder) {
    const std::filesystem::path parent = (folder / name).parent_path();
    std::vector<std::string> names;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(parent.empty() ? "." : parent, code))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    const std::string suggestion = nearest(name.filename().string(), names);
    return suggestion.empty() ? "" : fmt::format("; did you mean '{}'?", (name.parent_path() / suggestion).string());
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
    const std::string suggestion = nearest(word, candidates);
    if (!suggestion.empty()) return fmt::format("; did you mean '{}'?", suggestion);
    if (candidates.empty()) return {};
    return fmt::format("; one of: {}", fmt::join(candidates, ", "));
}

}  // namespace voxray

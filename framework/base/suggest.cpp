#include "base/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace voxray {
namespace {

bool isSame(char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

// Optimal string alignment distance: insertions, deletions, substitutions, swaps of neighbours. Capitals
// count as small letters.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t substitution = d[i - 1][j - 1] + (isSame(a[i - 1], b[j - 1]) ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, substitution});
            if (i > 1 && j > 1 && isSame(a[i - 1], b[j - 2]) && isSame(a[i - 2], b[j - 1]))
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
    std::string best;
    size_t bestDistance = std::max<size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        if (candidate == word) continue;  // It is known, but not here.
        const size_t distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    if (!best.empty() || word.empty()) return best;

    // A part of a name that says more: `rays` of `rays_per_block`, `pos` of `position`
    constexpr size_t kTelling = 3;
    const auto isPart = [&](const std::string& candidate) {
        return fmt::format("_{}_", candidate).find(fmt::format("_{}_", word)) != std::string::npos ||
               (word.size() >= kTelling && candidate.starts_with(word));
    };
    const auto whole = std::ranges::find_if(candidates, isPart);
    return whole == candidates.end() ? std::string() : *whole;
}

std::string didYouMeanFile(const std::filesystem::path& name, const std::filesystem::path& folder) {
    const std::filesystem::path place = (folder / name).parent_path();
    std::vector<std::string> names;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(place.empty() ? "." : place, code))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    const std::string near = nearest(name.filename().string(), names);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", (name.parent_path() / near).string());
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
    const std::string near = nearest(word, candidates);
    if (!near.empty()) return fmt::format("; did you mean '{}'?", near);
    if (candidates.empty()) return {};
    return fmt::format("; one of: {}", fmt::join(candidates, ", "));
}

}  // namespace voxray

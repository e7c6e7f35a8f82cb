#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxray {

/// The candidate nearest to `word` by edit distance (with transpositions), or "" where none is near
/// (more than a third of the letters differ).
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'x'?" for a near candidate, else "; one of: a, b, c".
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace voxray

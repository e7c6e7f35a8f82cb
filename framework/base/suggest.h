#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxray {

/// The candidate nearest to `word` by edit distance (with transpositions, case-insensitive). If more than a
/// third of the letters differ, the first candidate that has `word` as a component, as `rays` in
/// `rays_per_block`, or a prefix, as `pos` of `position`; else "".
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'x'?" for a missing file in `folder` if one has a similar name, else "".
std::string didYouMeanFile(const std::filesystem::path& name, const std::filesystem::path& folder = {});

/// "; did you mean 'x'?" for a similar candidate, else "; one of: a, b, c".
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace voxray

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxray {

/// The candidate nearest to `word` by edit distance (with transpositions, without regard to capitals); where
/// none is near (more than a third of the letters differ) the first that `word` is a part of, as `rays` of
/// `rays_per_block`, or begins, as `pos` does `position`; else "".
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'x'?" for a missing file, looked for in `folder`, where one is called nearly so there;
/// else "".
std::string didYouMeanFile(const std::filesystem::path& name, const std::filesystem::path& folder = {});

/// "; did you mean 'x'?" for a near candidate, else "; one of: a, b, c".
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace voxray

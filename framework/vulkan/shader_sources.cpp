#include "vulkan/shader_sources.h"

#include <regex>
#include <utility>

#include "base/files.h"

namespace voxray {

ShaderSources::ShaderSources(std::filesystem::path sourceRoot, const std::string& file)
    : sourceRoot_(std::move(sourceRoot)) {
    gather(std::filesystem::path(file).lexically_normal().generic_string());
}

void ShaderSources::gather(const std::string& file) {
    if (files_.contains(file)) return;
    const std::string& text = files_[file] = readTextFile(sourceRoot_ / file);
    static const std::regex include(R"re([ \t]*#[ \t]*include[ \t]*"([^"\n]+)")re");
    for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match)
        if (const auto found = resolve((*match)[1], file)) gather(*found);
}

std::optional<std::string> ShaderSources::resolve(const std::string& header,
                                                  const std::string& includer) const {
    const std::filesystem::path adjacent = std::filesystem::path(includer).parent_path() / header;
    for (const std::filesystem::path& candidate : {adjacent, std::filesystem::path(header)}) {
        const std::string name = candidate.lexically_normal().generic_string();
        if (files_.contains(name) || std::filesystem::is_regular_file(sourceRoot_ / name)) return name;
    }
    return std::nullopt;
}

}  // namespace voxray

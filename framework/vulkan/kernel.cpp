#include "vulkan/kernel.h"

#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"

namespace voxray {
namespace {

/// A shader relative to the source root: next to a source file, or as it is where it names its whole path.
std::string nextTo(std::string_view source, std::string_view file) {
    constexpr std::array<std::string_view, 5> kTopFolders{"passes/", "framework/", "tests/", "docs/examples/",
                                                          "shaders/"};
    for (const std::string_view top : kTopFolders)
        if (file.starts_with(top)) return std::string(file);

    // Compilers know sources by various paths.
    size_t root = 0;
    for (const std::string_view top : kTopFolders)
        for (size_t at = source.find(top); at != std::string_view::npos; at = source.find(top, at + 1))
            if (at == 0 || source[at - 1] == '/') root = std::max(root, at);
    return std::string(source.substr(root, source.find_last_of('/') + 1 - root)) + std::string(file);
}

std::vector<std::string> allNextTo(std::string_view source, const std::vector<std::string>& files) {
    std::vector<std::string> all;
    for (const std::string& file : files) all.push_back(nextTo(source, file));
    return all;
}

/// Calls f(0), f(1), ... on all cores. @throws what the first of them that throws has thrown.
template <class F>
void forEachInParallel(size_t count, const F& f) {
    std::vector<std::exception_ptr> errors(count);
    parallelRanges(count, 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) try {
                f(i);
            } catch (...) {
                errors[i] = std::current_exception();
            }
    });
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace

PassProgram::PassProgram(ProgramOwner& owner, std::vector<std::string> files, Defines defines)
    : owner_(owner), files_(std::move(files)), ownDefines_(std::move(defines)), defines_(ownDefines_) {
    owner_.programs_.push_back(this);
}

PassProgram::~PassProgram() {
    std::erase(owner_.programs_, this);
}

void PassProgram::define(const Defines& more) {
    Defines all = more;
    all.insert(ownDefines_.begin(), ownDefines_.end());
    if (all == defines_) return;
    defines_ = std::move(all);
    program_ = {};
}

void PassProgram::specialize(const SpecializationConstants& constants) {
    if (constants == constants_) return;
    constants_ = constants;
    program_ = {};
}

PassProgram::operator const Program&() const {
    if (!program_) throw Error("{}: it is dispatched, but plan() left it out", files_.front());
    return program_;
}

Kernel::Kernel(ProgramOwner& owner, std::string_view file, Defines defines, const char* sourceFile)
    : PassProgram(owner, {nextTo(sourceFile, file)}, std::move(defines)) {}

Program Kernel::make(Device& device, std::span<const ShaderModule> modules,
                     const SpecializationConstants& constants) const {
    return makeComputeProgram(device, modules.front(), constants);
}

RasterPipeline::RasterPipeline(ProgramOwner& owner, const std::vector<std::string>& files, RasterState state,
                               Defines defines, const char* sourceFile)
    : PassProgram(owner, allNextTo(sourceFile, files), std::move(defines)), state_(std::move(state)) {}

void RasterPipeline::setState(RasterState state) {
    state_ = std::move(state);
    program_ = {};
}

Program RasterPipeline::make(Device& device, std::span<const ShaderModule> modules,
                             const SpecializationConstants& constants) const {
    return makeRasterProgram(device, modules, state_, constants);
}

void compile(const std::vector<PassProgram*>& programs, Device& device, const ShaderCompiler& compiler) {
    using Source = std::pair<std::string, Defines>;
    std::vector<PassProgram*> asked;
    std::vector<Source> sources;
    for (PassProgram* program : programs) {
        if (!program->isUsed_ || program->program_) continue;
        asked.push_back(program);
        for (const std::string& file : program->files_) sources.emplace_back(file, program->defines_);
    }
    std::ranges::sort(sources);
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    std::vector<ShaderModule> modules(sources.size());
    forEachInParallel(sources.size(),
                      [&](size_t i) { modules[i] = compiler.compile(sources[i].first, sources[i].second); });

    forEachInParallel(asked.size(), [&](size_t i) {
        PassProgram& program = *asked[i];
        std::vector<ShaderModule> own;
        for (const std::string& file : program.files_) {
            const auto source = std::ranges::lower_bound(sources, Source{file, program.defines_});
            own.push_back(modules[size_t(source - sources.begin())]);
        }
        program.program_ = program.make(device, own, program.constants_);
    });
}

}  // namespace voxray

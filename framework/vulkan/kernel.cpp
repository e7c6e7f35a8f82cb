#include "vulkan/kernel.h"

#include <algorithm>
#include <array>
#include <exception>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/files.h"
#include "base/parallel.h"
#include "vulkan/program_cache.h"

namespace voxray {
namespace {

/// Path of a shader relative to the source root: in the folder of a source file, unless it begins with a top
/// folder.
std::string resolvePath(std::string_view source, std::string_view file) {
    constexpr std::array<std::string_view, 5> kTopFolders{"passes/", "framework/", "tests/", "docs/examples/",
                                                          "shaders/"};
    for (const std::string_view top : kTopFolders)
        if (file.starts_with(top)) return std::string(file);

    // __FILE__ may be absolute or relative.
    size_t root = 0;
    for (const std::string_view top : kTopFolders)
        for (size_t p = source.find(top); p != std::string_view::npos; p = source.find(top, p + 1))
            if (p == 0 || source[p - 1] == '/') root = std::max(root, p);
    return std::string(source.substr(root, source.find_last_of('/') + 1 - root)) + std::string(file);
}

std::vector<std::string> resolvePaths(std::string_view source, const std::vector<std::string>& files) {
    std::vector<std::string> paths;
    for (const std::string& file : files) paths.push_back(resolvePath(source, file));
    return paths;
}

/// Calls f(0), f(1), ... on all cores. @throws the exception of the lowest index that threw.
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

PassProgram::PassProgram(ProgramOwner& owner, std::vector<std::string> files, Defines defines, std::string text)
    : owner_(owner),
      files_(std::move(files)),
      text_(std::move(text)),
      baseDefines_(std::move(defines)),
      defines_(baseDefines_) {
    owner_.programs_.push_back(this);
}

PassProgram::~PassProgram() {
    std::erase(owner_.programs_, this);
}

void PassProgram::define(const Defines& more) {
    Defines defines = more;
    defines.insert(baseDefines_.begin(), baseDefines_.end());
    if (defines == defines_) return;
    defines_ = std::move(defines);
    program_ = {};
}

void PassProgram::specialize(const SpecializationConstants& constants) {
    if (constants == constants_) return;
    constants_ = constants;
    program_ = {};
}

PassProgram::operator const Program&() const {
    if (!program_) throw Error("{}: it is dispatched, but plan() left it out", files_.front());
    return *program_;
}

Kernel::Kernel(ProgramOwner& owner, std::string_view file, Defines defines, const char* sourceFile)
    : PassProgram(owner, {resolvePath(sourceFile, file)}, std::move(defines)) {}

Kernel::Kernel(ProgramOwner& owner, ShaderText source, Defines defines)
    : PassProgram(owner, {std::move(source.name)}, std::move(defines), std::move(source.text)) {}

Program Kernel::make(Device& device, std::span<const ShaderModule> modules,
                     const SpecializationConstants& constants) const {
    return makeComputeProgram(device, modules.front(), constants);
}

RasterPipeline::RasterPipeline(ProgramOwner& owner, const std::vector<std::string>& files, RasterState state,
                               Defines defines, const char* sourceFile)
    : PassProgram(owner, resolvePaths(sourceFile, files), std::move(defines)), state_(std::move(state)) {}

void RasterPipeline::setState(RasterState state) {
    state_ = std::move(state);
    program_ = {};
}

void RasterPipeline::addState(Hasher& hash) const {
    hash.addPlain(state_.colorFormats.size());
    for (const VkFormat format : state_.colorFormats) hash.addPlain(format);
    hash.addPlain(state_.depthFormat).addPlain(state_.depthCompare).addPlain(state_.cull);
    hash.addPlain(state_.frontFace).addPlain(state_.writeColor);
    hash.addPlain(state_.isConservative).addPlain(state_.samples).addPlain(state_.viewports);
}

Program RasterPipeline::make(Device& device, std::span<const ShaderModule> modules,
                             const SpecializationConstants& constants) const {
    return makeRasterProgram(device, modules, state_, constants);
}

void compile(const std::vector<PassProgram*>& programs, Device& device, const ShaderCompiler& compiler) {
    using Source = std::tuple<std::string, Defines, std::string>;  // File, definitions, text
    std::vector<PassProgram*> pending;
    std::vector<Source> sources;
    for (PassProgram* program : programs) {
        if (!program->isUsed_ || program->program_) continue;
        pending.push_back(program);
        for (const std::string& file : program->files_) sources.emplace_back(file, program->defines_, program->text_);
    }
    std::ranges::sort(sources);
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    std::vector<std::shared_ptr<const ShaderModule>> modules(sources.size());
    forEachInParallel(sources.size(), [&](size_t i) {
        const auto& [file, defines, text] = sources[i];
        modules[i] = compiler.compile(file, defines, text);
    });

    forEachInParallel(pending.size(), [&](size_t i) {
        PassProgram& program = *pending[i];
        std::vector<const ShaderModule*> stages;
        Hasher hash;  // Without defines, whose effect is in the SPIR-V
        for (const std::string& file : program.files_) {
            const auto source = std::ranges::lower_bound(sources, Source{file, program.defines_, program.text_});
            const ShaderModule& module = *stages.emplace_back(modules[size_t(source - sources.begin())].get());
            hash.add(file).add(module.hash);
        }
        for (const auto& [name, value] : program.constants_) hash.add(name).addPlain(value);
        program.addState(hash);
        program.program_ = device.programCache().get(hash.hex(), [&] {
            std::vector<ShaderModule> copies;
            for (const ShaderModule* stage : stages) copies.push_back(*stage);
            return program.make(device, copies, program.constants_);
        });
    });
}

}  // namespace voxray

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/program.h"

/// Programs as members of a pass: they register with it, and all of a graph are compiled at once.
namespace voxray {

class PassProgram;

/// What programs are members of: a pass, also for the parts of it that several passes share.
class ProgramOwner {
 public:
    ProgramOwner() = default;
    ProgramOwner(const ProgramOwner&) = delete;
    ProgramOwner& operator=(const ProgramOwner&) = delete;
    const std::vector<PassProgram*>& programs() const { return programs_; }

 protected:
    ~ProgramOwner() = default;

 private:
    friend class PassProgram;
    std::vector<PassProgram*> programs_;
};

/// A program that is compiled after its pass has planned and before it records.
class PassProgram {
 public:
    virtual ~PassProgram();
    PassProgram(const PassProgram&) = delete;
    PassProgram& operator=(const PassProgram&) = delete;

    /// Adds preprocessor definitions to those that were given at first, in place of those of an earlier call.
    /// In plan(), as specialize() and compileIf().
    void define(const Defines& more);
    /// Values of specialization constants.
    void specialize(const SpecializationConstants& constants);
    /// Programs that aren't dispatched needn't be compiled.
    void compileIf(bool isUsed) { isUsed_ = isUsed; }

    /// @throws Error where it isn't compiled.
    operator const Program&() const;

 protected:
    PassProgram(ProgramOwner& owner, std::vector<std::string> files, Defines defines);

    Program program_;

 private:
    friend void compile(const std::vector<PassProgram*>&, Device&, const ShaderCompiler&);
    virtual Program make(Device& device, std::span<const ShaderModule> modules,
                         const SpecializationConstants& constants) const = 0;

    ProgramOwner& owner_;
    std::vector<std::string> files_;  ///< Relative to the source root.
    Defines ownDefines_, defines_;
    SpecializationConstants constants_;
    bool isUsed_ = true;
};

/// A compute shader, such as Kernel{*this, "composite.comp"}.
class Kernel final : public PassProgram {
 public:
    /// @param file next to the source file that makes the kernel, or from "passes/" or "shaders/" on.
    Kernel(ProgramOwner& owner, std::string_view file, Defines defines = {},
           const char* sourceFile = __builtin_FILE());

 private:
    Program make(Device& device, std::span<const ShaderModule> modules,
                 const SpecializationConstants& constants) const override;
};

/// A raster pipeline of shaders, such as RasterPipeline{*this, {"gbuffer.vert", "gbuffer.frag"}}.
class RasterPipeline final : public PassProgram {
 public:
    /// @param files as of a kernel, one a stage.
    RasterPipeline(ProgramOwner& owner, const std::vector<std::string>& files, RasterState state = {},
                   Defines defines = {}, const char* sourceFile = __builtin_FILE());
    /// In plan().
    void setState(RasterState state);

 private:
    Program make(Device& device, std::span<const ShaderModule> modules,
                 const SpecializationConstants& constants) const override;

    RasterState state_;
};

/// Compiles those programs that are used and not compiled yet, on all cores; shaders that several have in
/// common once. @throws Error as ShaderCompiler::compile() and makeComputeProgram(): that of the first.
void compile(const std::vector<PassProgram*>& programs, Device& device, const ShaderCompiler& compiler);

}  // namespace voxray

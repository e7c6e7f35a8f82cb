#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/program.h"

/// Programs as members of a pass, which register with it. The graph compiles those of all passes in parallel.
namespace voxray {

class Hasher;
class PassProgram;

/// Owner of programs: a pass, passed on to the classes that several passes share.
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

    /// Sets preprocessor definitions in addition to those of the constructor. This and the next two are
    /// called in plan().
    void define(const Defines& more);
    /// Sets the values of specialization constants.
    void specialize(const SpecializationConstants& constants);
    /// Skips compilation of a program that won't be dispatched.
    void compileIf(bool isUsed) { isUsed_ = isUsed; }

    /// @throws Error if it isn't compiled.
    operator const Program&() const;

 protected:
    PassProgram(ProgramOwner& owner, std::vector<std::string> files, Defines defines, std::string text = {});

    std::shared_ptr<const Program> program_;  ///< Null until it is compiled.

 private:
    friend void compile(const std::vector<PassProgram*>&, Device&, const ShaderCompiler&);
    virtual Program make(Device& device, std::span<const ShaderModule> modules,
                         const SpecializationConstants& constants) const = 0;
    /// Adds what the program depends on besides modules and constants.
    virtual void addState(Hasher&) const {}

    ProgramOwner& owner_;
    std::vector<std::string> files_;  ///< Relative to the source root.
    std::string text_;                ///< Of the only file, where that is not on the disk.
    Defines baseDefines_, defines_;   ///< Those of the constructor; and with those of define().
    SpecializationConstants constants_;
    bool isUsed_ = true;
};

/// GLSL of a compute shader that is no file of the source root.
struct ShaderText {
    std::string name;  ///< In messages, without a colon; includes are searched next to it, too.
    std::string text;
};

/// A compute shader, such as Kernel{*this, "composite.comp"}.
class Kernel final : public PassProgram {
 public:
    Kernel(ProgramOwner& owner, ShaderText source, Defines defines = {});
    /// @param file relative to the folder of `sourceFile`, or from "passes/" or "shaders/" on.
    Kernel(ProgramOwner& owner, std::string_view file, Defines defines = {}, const char* sourceFile = __builtin_FILE());

 private:
    Program make(Device& device, std::span<const ShaderModule> modules,
                 const SpecializationConstants& constants) const override;
};

/// A raster pipeline of shaders, such as RasterPipeline{*this, {"gbuffer.vert", "gbuffer.frag"}}.
class RasterPipeline final : public PassProgram {
 public:
    /// @param files as of a kernel, one per stage.
    RasterPipeline(ProgramOwner& owner, const std::vector<std::string>& files, RasterState state = {},
                   Defines defines = {}, const char* sourceFile = __builtin_FILE());
    /// In plan().
    void setState(RasterState state);

 private:
    Program make(Device& device, std::span<const ShaderModule> modules,
                 const SpecializationConstants& constants) const override;
    void addState(Hasher& hash) const override;

    RasterState state_;
};

/// Compiles the used programs that aren't compiled yet, on all cores, shared shaders once. Programs that are
/// equal to those of another graph of the device are shared with it.
/// @throws Error of the first that fails, as ShaderCompiler::compile() and makeComputeProgram().
void compile(const std::vector<PassProgram*>& programs, Device& device, const ShaderCompiler& compiler);

}  // namespace voxray

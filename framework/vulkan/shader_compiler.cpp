#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <array>
#include <cstring>
#include <list>
#include <mutex>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "vulkan/program.h"
#include "vulkan/reflect.h"
#include "vulkan/shader_sources.h"

namespace voxray {
namespace {

struct Stage {
    const char* extension;
    EShLanguage language;
    VkShaderStageFlagBits flag;
};
constexpr std::array kStages{
    Stage{".comp", EShLangCompute, VK_SHADER_STAGE_COMPUTE_BIT},
    Stage{".vert", EShLangVertex, VK_SHADER_STAGE_VERTEX_BIT},
    Stage{".geom", EShLangGeometry, VK_SHADER_STAGE_GEOMETRY_BIT},
    Stage{".frag", EShLangFragment, VK_SHADER_STAGE_FRAGMENT_BIT},
    Stage{".rgen", EShLangRayGen, VK_SHADER_STAGE_RAYGEN_BIT_KHR},
    Stage{".rmiss", EShLangMiss, VK_SHADER_STAGE_MISS_BIT_KHR},
    Stage{".rchit", EShLangClosestHit, VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR},
    Stage{".rahit", EShLangAnyHit, VK_SHADER_STAGE_ANY_HIT_BIT_KHR},
};

constexpr int kGlslVersion = 460;
/// Enabled in all shaders.
constexpr std::array kExtensions{
    "GL_GOOGLE_include_directive",
    "GL_EXT_scalar_block_layout",
    "GL_EXT_buffer_reference",
    "GL_EXT_shader_explicit_arithmetic_types_int64",
    "GL_EXT_shader_atomic_int64",
    "GL_EXT_nonuniform_qualifier",
    "GL_EXT_ray_query",
    "GL_EXT_ray_tracing",
};

const Stage& stageOf(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    for (const Stage& stage : kStages)
        if (extension == stage.extension) return stage;
    throw Error("{}: unknown kind of shader '{}'", file, extension);
}

/// Serves includes from the sources that the cache key was computed from.
class Includer final : public glslang::TShader::Includer {
 public:
    explicit Includer(const ShaderSources& sources) : sources_(sources) {}

    IncludeResult* includeLocal(const char* header, const char* includer, size_t) override {
        const auto name = sources_.resolve(header, includer);
        const auto file = name ? sources_.files().find(*name) : sources_.files().end();
        if (file == sources_.files().end()) return nullptr;
        return &results_.emplace_back(file->first, file->second.data(), file->second.size(), nullptr);
    }
    void releaseInclude(IncludeResult*) override {}

 private:
    const ShaderSources& sources_;
    std::list<IncludeResult> results_;
};

/// Initializes glslang's process-wide tables, once.
void initialiseCompiler() {
    static const bool ready = glslang::InitializeProcess();
    if (!ready) throw Error("glslang can't be initialised");
}

/// glslang's log as "file:line: message; ...", without its summary and lines without a location.
std::string formatLog(const std::string& file, const std::string& log) {
    static const std::regex located(R"(^(ERROR|WARNING): ([^:]+):(\d+): (.*)$)");
    std::string out;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, located) || match[1] != "ERROR") continue;
        if (match[4].str().find("compilation terminated") != std::string::npos) continue;
        if (!out.empty()) out += "; ";
        out += fmt::format("{}:{}: {}", match[2].str(), match[3].str(), match[4].str());
    }
    return out.empty() ? fmt::format("{}: {}", file, log) : out;
}

std::vector<uint32_t> compileGlsl(const std::string& file, const Stage& stage, const ShaderSources& sources,
                                  const Defines& defines) {
    initialiseCompiler();
    const std::string name = std::filesystem::path(file).lexically_normal().generic_string();
    const std::string& text = sources.files().at(name);
    std::string preamble;
    for (const char* extension : kExtensions) preamble += fmt::format("#extension {} : require\n", extension);
    for (const auto& [key, value] : defines) preamble += fmt::format("#define {} {}\n", key, value);

    glslang::TShader shader(stage.language);
    const char* texts[] = {text.c_str()};
    const int lengths[] = {int(text.size())};
    const char* names[] = {name.c_str()};
    shader.setStringsWithLengthsAndNames(texts, lengths, names, 1);
    shader.setPreamble(preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage.language, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    shader.setAutoMapBindings(true);

    // One stage per program: stages are linked in the pipeline.
    const auto messages = EShMessages(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(sources);
    if (!shader.parse(GetDefaultResources(), kGlslVersion, false, messages, includer))
        throw Error("{}", formatLog(name, shader.getInfoLog()));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO()) throw Error("{}", formatLog(name, program.getInfoLog()));
    std::vector<uint32_t> spirv;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(stage.language), spirv, &options);
    return spirv;
}

/// Key of a compiled shader: everything that the SPIR-V depends on.
std::string cacheKey(const std::string& file, const ShaderSources& sources, const Defines& defines) {
    Hasher hash;
    hash.add("voxray SPIR-V 1.6, bindings assigned, extensions given")
        .addPlain(GLSLANG_VERSION_MAJOR)
        .addPlain(GLSLANG_VERSION_MINOR);
    hash.addPlain(GLSLANG_VERSION_PATCH).addPlain(glslang::GetSpirvGeneratorVersion()).add(file);
    hash.addPlain(sources.files().size());
    for (const auto& [name, text] : sources.files()) hash.add(name).add(text);
    for (const auto& [name, value] : defines) hash.add(name).add(value);
    return hash.hex();
}

/// A cache file is the hash of the SPIR-V, 32 digits, then the SPIR-V. Empty if it is missing or corrupt.
std::vector<uint32_t> readCached(const std::filesystem::path& path) {
    constexpr size_t kDigits = 32;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    const std::vector<uint8_t> content = readFile(path);
    if (content.size() <= kDigits || (content.size() - kDigits) % 4 != 0) return {};
    const uint8_t* words = content.data() + kDigits;
    const size_t bytes = content.size() - kDigits;
    const std::string hash = Hasher().add(words, bytes).hex();
    if (hash.size() != kDigits || std::memcmp(hash.data(), content.data(), kDigits) != 0) return {};
    std::vector<uint32_t> spirv(bytes / 4);
    std::memcpy(spirv.data(), words, bytes);
    return spirv;
}

/// Ignores errors: without a cache compilation only takes longer.
void writeCached(const std::filesystem::path& path, const std::vector<uint32_t>& spirv) {
    std::string content = Hasher().add(spirv.data(), spirv.size() * 4).hex();
    content.append(reinterpret_cast<const char*>(spirv.data()), spirv.size() * 4);
    try {
        std::filesystem::create_directories(path.parent_path());
        writeFileAtomically(path, std::string_view(content));
    } catch (const std::exception&) {
        return;
    }
}

}  // namespace

/// Modules in memory, to be compiled neither again nor read and reflected again.
class ShaderCompiler::KnownModules {
 public:
    using Key = std::tuple<std::string, Defines, std::string>;  ///< File, defines, text.

    /// The module of a file and defines; null if it isn't known, or its files have changed.
    std::shared_ptr<const ShaderModule> find(const Key& key) {
        const std::lock_guard lock(mutex_);
        const auto known = known_.find(key);
        return known != known_.end() && known->second.stamps.areCurrent() ? known->second.module : nullptr;
    }
    void add(const Key& key, FileStamps stamps, std::shared_ptr<const ShaderModule> module) {
        const std::lock_guard lock(mutex_);
        if (known_.size() >= kMaxModules) known_.clear();
        known_.insert_or_assign(key, Known{std::move(stamps), std::move(module)});
    }

 private:
    static constexpr size_t kMaxModules = 256;  // Several times those of a graph
    struct Known {
        FileStamps stamps;
        std::shared_ptr<const ShaderModule> module;
    };
    std::mutex mutex_;
    std::map<Key, Known> known_;
};

ShaderCompiler::ShaderCompiler(std::filesystem::path sourceRoot, std::filesystem::path cacheFolder)
    : sourceRoot_(std::move(sourceRoot)),
      cacheFolder_(std::move(cacheFolder)),
      known_(std::make_unique<KnownModules>()) {}

ShaderCompiler::~ShaderCompiler() = default;

std::shared_ptr<const ShaderModule> ShaderCompiler::compile(const std::string& file, const Defines& defines,
                                                            const std::string& text) const {
    if (auto known = known_->find({file, defines, text})) return known;
    const ShaderSources sources(sourceRoot_, file, text);
    auto module = std::make_shared<const ShaderModule>(make(file, defines, text, sources));
    known_->add({file, defines, text}, sources.stamps(), module);
    return module;
}

ShaderModule ShaderCompiler::make(const std::string& file, const Defines& defines, const std::string& text,
                                  const ShaderSources& sources) const {
    const Stage& stage = text.empty() ? stageOf(file) : kStages.front();
    ShaderModule module;
    module.file = file;
    module.stage = stage.flag;

    const bool cached = !cacheFolder_.empty();
    const std::filesystem::path path =
        cached ? cacheFolder_ / "spirv" / (cacheKey(file, sources, defines) + ".spv") : std::filesystem::path();
    if (cached) module.spirv = readCached(path);
    if (module.spirv.empty()) {
        module.spirv = compileGlsl(file, stage, sources, defines);
        if (cached) writeCached(path, module.spirv);
    }
    module.hash = Hasher().add(module.spirv.data(), module.spirv.size() * sizeof(uint32_t)).hex();
    reflect(module);
    return module;
}

}  // namespace voxray

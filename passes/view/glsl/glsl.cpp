#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <regex>
#include <string>
#include <string_view>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

enum class KernelLight { Indirect, Direct };
template <>
struct EnumNames<KernelLight> {
    static constexpr std::array names{std::pair{KernelLight::Indirect, "indirect"},
                                      std::pair{KernelLight::Direct, "direct"}};
};

enum class KernelOutput { Final, Indirect, Direct };
template <>
struct EnumNames<KernelOutput> {
    static constexpr std::array names{std::pair{KernelOutput::Final, "final"},
                                      std::pair{KernelOutput::Indirect, "indirect"},
                                      std::pair{KernelOutput::Direct, "direct"}};
};

/// An image by a function in GLSL that the config gives. What it reads follows from the words of its text.
class Glsl final : public Pass {
 public:
    static constexpr const char* kName = "glsl";
    static constexpr const char* kHelp =
        "Makes an image by a GLSL function that the config gives. "
        "The text defines 'vec3 shade(ivec2 pixel, ivec2 texel)', which is called for each texel of the G-buffer; a "
        "pixel is the mean of its texels. It may read the G-buffer's images, directImage, indirectImage and finalImage, "
        "and voxelIrradianceAt(position, normal); the pass has the ports of those that the text names. "
        "Bias and noise: the text's own. Source: docs/writing-a-pass.md.";
    struct Params {
        std::string source;
        TextFile file;
        KernelOutput writes = KernelOutput::Final;
        KernelLight light = KernelLight::Indirect;
        glm::vec3 values{0.0f};
        static constexpr auto schema() {
            return std::tuple{
                field("source", &Params::source, "The GLSL text; or name a 'file' that holds it."),
                field("file", &Params::file,
                      "File with the GLSL text, relative to the config; with --set, to the current folder."),
                field("writes", &Params::writes, "Image that the pass writes."),
                field("light", &Params::light, "Light that voxelIrradianceAt() looks up."),
                field("values", &Params::values, "Three numbers, 'kernel.values' in the text.", glm::vec3(-1e9f),
                      glm::vec3(1e9f))};
        }
        const std::string& text() const { return file.name.empty() ? source : file.text; }
        /// Whether the text has a word; true without a text, so that help lists all ports.
        bool names(std::string_view word) const;
    };
    explicit Glsl(const Params& params) : params_(params) {}

    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    static constexpr const char* kLookup = "voxelIrradianceAt";
    /// Whether it takes an image: one that the text names, and that of the name which it writes, so that what stands
    /// before it is not left out.
    bool reads(KernelOutput image, std::string_view word) const {
        return params_.writes == image || params_.names(word);
    }
    ShaderText shader() const;
    Defines defines() const;

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    InOptional<FrameImage> direct_{*this, "direct", "directImage of the text",
                                   reads(KernelOutput::Direct, "directImage")};
    InOptional<FrameImage> indirect_{*this, "indirect", "indirectImage of the text",
                                     reads(KernelOutput::Indirect, "indirectImage")};
    InOptional<FrameImage> before_{*this, "final", "finalImage of the text", reads(KernelOutput::Final, "finalImage")};
    InOptional<VoxelLevels> voxels_{*this, "voxels", "surface voxels", params_.names(kLookup)};
    InOptional<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces",
                                            params_.names(kLookup)};
    Out<FrameImage> result_{*this, enumName(params_.writes), "what the text makes"};
    Kernel kernel_{*this, shader(), defines()};
};

bool Glsl::Params::names(std::string_view word) const {
    const std::string& code = text();
    if (code.empty()) return true;
    const auto isPart = [&](size_t i) {
        return i < code.size() && (std::isalnum((unsigned char)(code[i])) || code[i] == '_');
    };
    for (size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1))
        if (!isPart(at + word.size()) && (at == 0 || !isPart(at - 1))) return true;
    return false;
}

ShaderText Glsl::shader() const {
    const bool isFile = !params_.file.name.empty();
    return {isFile ? std::filesystem::absolute(params_.file.path).string() : "source",
            "#include \"passes/view/glsl/kernel.glsl\"\n#line 1\n" + params_.text() + "\n"};
}

Defines Glsl::defines() const {
    Defines words;
    for (const char* word : {"directImage", "indirectImage", "finalImage", kLookup})
        if (params_.names(word)) words.emplace("NAMES_" + std::string(word), "1");
    return words;
}

namespace {

std::string withoutComments(const std::string& text) {
    std::string code;
    for (size_t at = 0; at < text.size();) {
        const std::string_view begin = std::string_view(text).substr(at, 2);
        const bool isLine = begin == "//", isBlock = begin == "/*";
        if (!isLine && !isBlock) {
            code += text[at++];
            continue;
        }
        const size_t end = isLine ? text.find('\n', at) : text.find("*/", at + 2);
        at = end == std::string::npos ? text.size() : isLine ? end : end + 2;
        code += ' ';
    }
    return code;
}

/// @throws Error unless a text defines the function that is called.
void requireShade(const std::string& text) {
    constexpr const char* kCalled = "vec3 shade(ivec2 pixel, ivec2 texel)";
    const std::regex function(R"((\w+)\s+shade\s*\(([^)]*)\)\s*\{)");
    const std::regex parameters(R"(\s*((const|in)\s+)*ivec2\s+\w+\s*,\s*((const|in)\s+)*ivec2\s+\w+\s*)");
    const std::string code = withoutComments(text);
    std::string other;
    for (std::sregex_iterator found(code.begin(), code.end(), function), end; found != end; ++found) {
        if ((*found)[1] == "vec3" && std::regex_match((*found)[2].str(), parameters)) return;
        other = fmt::format("{} shade({})", (*found)[1].str(), (*found)[2].str());
    }
    if (other.empty()) throw Error("{}: the text defines no {}", Glsl::kName, kCalled);
    throw Error("{}: the text defines '{}', which has to be '{}'", Glsl::kName, other, kCalled);
}

}  // namespace

void Glsl::plan(PassPlan& plan) {
    if (params_.source.empty() == params_.file.name.empty())
        throw Error("{}: give either a 'source', the GLSL text, or a 'file' that holds it", kName);
    requireShade(params_.text());
    const auto require = [&](const auto& port, const char* word, const char* written) {
        if (params_.names(word) && !plan[port])
            throw Error("{}: the text reads {}, but no pass before it writes '{}'", kName, word, written);
    };
    require(direct_, "directImage", "direct");
    require(indirect_, "indirectImage", "indirect");
    require(before_, "finalImage", "final");
    require(voxels_, kLookup, "voxels");
    require(irradiance_, kLookup, "irradiance");
    plan.frameImage(result_);
}

void Glsl::record(PassContext& context) {
    std::vector<Binding> all = context[gbuffer_].bindings();
    const auto add = [&](std::vector<Binding> more) {
        for (Binding& binding : more) all.push_back(ifUsed(std::move(binding)));
    };
    add({{"directImage", context.orBlack(direct_)},
         {"indirectImage", context.orBlack(indirect_)},
         {"finalImage", context.orBlack(before_)},
         {"seed", randomSeed(context.frame, context.frameIndex)},
         {"values", params_.values}});
    if (const VoxelLevels* voxels = context[voxels_]) add(voxels->bindings());
    if (const VoxelIrradiance* irradiance = context[irradiance_])
        add({{"VoxelFluxRef", (params_.light == KernelLight::Direct ? irradiance->direct : irradiance->indirect).ref()},
             {"voxelArea", irradiance->area}});
    context.dispatch(kernel_, context.frame.pixels(), {{all}, {"result", context[result_].image}});
}

VOXRAY_REGISTER_PASS(Glsl);

}  // namespace voxray

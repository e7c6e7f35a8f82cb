#include <cstdlib>
#include <filesystem>

#include "base/child_process.h"
#include "base/error.h"
#include "graph/registry.h"
#include "graph/warmup.h"
#include "passes/external/external_images.h"
#include "scene/gltf_sidecar.h"

namespace voxray {

template <>
struct EnumNames<ExternalLight> {
    static constexpr std::array names{std::pair{ExternalLight::Total, "total"},
                                      std::pair{ExternalLight::Parts, "parts"}};
};

namespace {

constexpr size_t kToldLines = 6;  ///< Of what a program that failed said last.

/// A folder for the exchange with a program, deleted with all in it.
class ExchangeFolder {
 public:
    ExchangeFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "voxray-external-XXXXXX").string();
        if (!::mkdtemp(name.data()))
            throw Error("can't make a folder in {}", std::filesystem::temp_directory_path().string());
        path_ = name;
    }
    ~ExchangeFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ExchangeFolder(const ExchangeFolder&) = delete;
    ExchangeFolder& operator=(const ExchangeFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

bool isSame(const Camera& a, const Camera& b) {
    return a.position == b.position && a.forward == b.forward && a.up == b.up &&
           a.verticalFovRadians == b.verticalFovRadians;
}

void upload(CommandStream& stream, const ImageF& source, const Image& target) {
    std::vector<float> rgba(source.pixelCount() * 4, 1.0f);
    for (size_t i = 0; i < source.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c) rgba[4 * i + c] = source.data[source.channels * i + c];
    stream.upload(target, std::as_bytes(std::span(rgba)));
    stream.finish();
}

}  // namespace

/// Another renderer as a pass: a program that renders the exported scene, or images that it left.
class External final : public Pass {
 public:
    static constexpr const char* kName = "external";
    static constexpr bool kNeedsDevice = false;
    static constexpr const char* kHelp =
        "Takes the image of another renderer. "
        "A program gets the scene as glTF with a side-car and writes EXR files, once for a scene, camera and seed; or "
        "'images' names a folder of such files. Bias: the other renderer's own; noisy by: spp. Source: docs/external.md.";
    struct Params {
        ProgramCommand command;
        FolderName images;
        uint32_t spp = 64;
        uint32_t bounces = 8;
        ExternalLight light = ExternalLight::Total;
        bool eachFrame = false;
        double timeoutS = 3600;
        std::string install;
        static constexpr auto schema() {
            return std::tuple{
                field("command", &Params::command,
                      "Program and arguments, a word each; the path of the side-car follows. It runs in the folder of "
                      "the config, where it has to stand, and without a shell. Or name 'images'."),
                field("images", &Params::images,
                      "Folder of final.exr, or of direct.exr and indirect.exr, and time.json; relative to the config."),
                field("spp", &Params::spp, "Samples a pixel that the program is asked for.", 1u, 1u << 20).lessNoise(),
                field("bounces", &Params::bounces,
                      "Scattering events after direct light at the first hit, which the program is asked for, or which "
                      "the images have.",
                      0u, 1024u),
                field("light", &Params::light,
                      "total: final.exr. parts: direct.exr and indirect.exr, so that indirect light is scored, too."),
                field("each_frame", &Params::eachFrame,
                      "Runs the program for each frame in turn, also where scene and camera are those of the last one: "
                      "for a renderer that keeps light of earlier frames. The side-car has the 'frame', the first "
                      "measured one is 0; warm-up frames have none."),
                field("timeout_s", &Params::timeoutS, "Seconds after which the program is ended; 0: none.", 0.0, 1e6),
                field("install", &Params::install, "How to get the program; told where it is missing.")};
        }
    };
    explicit External(const Params& params) : params_(params) {}

    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool hasParts() const { return params_.light == ExternalLight::Parts; }
    std::filesystem::path programFolder() const {
        return std::filesystem::absolute(params_.command.file).parent_path();
    }
    void requireProgram() const;
    /// @return seconds by the wall clock.
    double runProgramIn(const std::filesystem::path& folder, const PassContext& context) const;
    Value request(const PassContext& context) const;
    bool isRendered(const Frame& frame) const;

    const Params params_;
    Out<FrameImage> final_{*this, "final", "radiance towards the camera"};
    Out<FrameImage> indirect_{*this, "indirect", "its fraction that was scattered more than once",
                              params_.light == ExternalLight::Parts};

    /// What was rendered last, and how long that took.
    struct Rendered {
        Camera camera;
        uint64_t seed;
        uint64_t sceneVersion;
        PassContext::ToldTime time;
    };
    std::optional<Rendered> rendered_;
};

void External::requireProgram() const {
    const ProgramCommand& command = params_.command;
    if (!std::filesystem::is_regular_file(command.file))
        throw Error("{}.command: a program runs only from a config's file, not from {}", kName,
                    command.file.empty() ? "a request" : command.file);
    if (!findProgram(command.words[0], programFolder()).empty()) return;
    const std::string install = params_.install.empty() ? "install it, or write its whole path" : params_.install;
    throw Error("{}.command: there is no program '{}': {}", kName, command.words[0], install);
}

void External::plan(PassPlan& plan) {
    if (params_.command.words.empty() == params_.images.name.empty())
        throw Error("{}: give either a 'command', the words of a program, or 'images', a folder", kName);
    if (params_.eachFrame && params_.command.words.empty())
        throw Error("{}.each_frame: 'images' holds one frame; give a 'command'", kName);
    if (!params_.command.words.empty()) requireProgram();
    for (const Out<FrameImage>* port : {&final_, &indirect_}) {
        if (port == &indirect_ && !hasParts()) continue;
        plan[*port].lightBounces = params_.bounces;
        plan[*port].hasSpecularLobes = true;
        plan.frameImage(*port);
    }
}

Value External::request(const PassContext& context) const {
    Value more = Value::map();
    const auto add = [&](const char* key, auto value) { more.set(key, Value::fromScalar(fmt::format("{}", value))); };
    add("spp", params_.spp);
    add("bounces", params_.bounces);
    add("seed", context.frame.seed);
    if (params_.eachFrame && !isWarmup(context.frameIndex)) add("frame", context.frameIndex);
    more.set("light", Value::fromScalar(enumName(params_.light), true));
    return more;
}

double External::runProgramIn(const std::filesystem::path& folder, const PassContext& context) const {
    const Frame& frame = context.frame;
    const ExportedView view{frame.camera, frame.width, frame.height, frame.exposureStops};
    SceneState seen = *frame.scene;
    seen.cameras = {frame.camera};
    std::vector<std::string> words = params_.command.words;
    words.push_back(exportForRenderers(seen, view, folder / "scene.glb", request(context)).string());
    const ProgramEnd end = runProgram(words, programFolder(), params_.timeoutS);
    const std::string said = lastLines(end.output, kToldLines);
    if (end.isLate)
        throw Error("{}: {} was ended after timeout_s = {:g} s; it said: {}", kName, words[0], params_.timeoutS, said);
    if (end.status != 0)
        throw Error("{}: {} failed with exit status {}; it said: {}", kName, words[0], end.status,
                    said.empty() ? "nothing" : said);
    return end.seconds;
}

bool External::isRendered(const Frame& frame) const {
    return !params_.eachFrame && rendered_ && isSame(rendered_->camera, frame.camera) &&
           rendered_->seed == frame.seed && rendered_->sceneVersion == frame.sceneVersion;
}

void External::record(PassContext& context) {
    const Frame& frame = context.frame;
    if (isRendered(frame)) {
        context.tellTime(rendered_->time.milliseconds, rendered_->time.clock);
        context.markOutputsUnchanged();
        return;
    }
    const bool isProgram = !params_.command.words.empty();
    std::optional<ExchangeFolder> exchange;
    double wallSeconds = 0;
    if (isProgram) {
        requireProgram();
        wallSeconds = runProgramIn(exchange.emplace().path(), context);
    }
    const std::filesystem::path folder = isProgram ? exchange->path() : std::filesystem::path(params_.images.path);
    const ExternalImages images = readExternalImages(folder, params_.light, frame.width, frame.height);
    upload(context.stream, images.final, context[final_].image);
    if (hasParts()) upload(context.stream, images.indirect, context[indirect_].image);
    if (!isProgram && !images.renderSeconds)
        throw Error("{} is missing: write {{\"render_seconds\": SECONDS}} into it, what rendering took",
                    (folder / kTimeFile).string());
    rendered_ = {frame.camera,
                 frame.seed,
                 frame.sceneVersion,
                 {1000 * images.renderSeconds.value_or(wallSeconds),
                  images.renderSeconds ? "told by the renderer" : "wall clock of the program"}};
    context.tellTime(rendered_->time.milliseconds, rendered_->time.clock);
}

VOXRAY_REGISTER_PASS(External);

}  // namespace voxray

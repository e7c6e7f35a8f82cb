#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/image_requests.h"
#include "app/look_reference.h"
#include "app/look_server.h"
#include "app/open_config.h"
#include "app/planning.h"
#include "app/session_requests.h"
#include "app/text_values.h"
#include "app/view_requests.h"
#include "base/interrupt.h"
#include "config/overrides.h"
#include "experiment/config_schema.h"
#include "experiment/study.h"
#include "passes/common/families.h"

namespace voxray {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kOtherRenderers = "external";  ///< Family of passes.

/// Between looks at whether Ctrl-C was pressed, and after an image before a reference is rendered on.
constexpr std::chrono::milliseconds kPatience{100};
/// References are rendered for about this long at a time.
constexpr std::chrono::milliseconds kSlice{100};

struct LookArguments : ConfigArguments {
    std::filesystem::path file;
    RunOptions options;
    int port = 0;
};

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The file or built-in scene of a config; null if it names none.
Value sourceOf(const Value& config) {
    for (const char* key : {"scene.file", "scene.builtin"})
        if (const Value* source = valueAt(config, key)) return *source;
    return {};
}

/// Names of results folders where a run would write, which another run of that name replaces.
Value resultsHere() {
    Value names = Value::list();
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator("results", code))
        names.items.push_back(quotedText(entry.path().filename().string()));
    return names;
}

/// A port of a pass, for the page.
Value portValue(const PortDoc& port) {
    Value value = Value::map();
    value.set("name", quotedText(port.name));
    value.set("optional", flag(port.optional));
    value.set("with", quotedText(port.with));
    return value;
}

/// Names, ports and families of passes, which the schema lacks.
Value passesOf(const Registry& registry) {
    Value passes = Value::map();
    for (const PassKind& kind : registry.kinds()) {
        Value pass = Value::map(), inputs = Value::list(), outputs = Value::list();
        for (const PortDoc& port : kind.ports) (port.output ? outputs : inputs).items.push_back(portValue(port));
        pass.set("family", quotedText(kind.family));
        pass.set("inputs", std::move(inputs));
        pass.set("outputs", std::move(outputs));
        passes.set(kind.name, std::move(pass));
    }
    return passes;
}

/// Keeps the changes that a config allows. @return the others, each with its path and error.
Value keep(ShownState& state, const std::vector<ShownState::Change>& changes) {
    Value refused = Value::list();
    for (const auto& [path, value] : changes) try {
            state.set(path, value);
        } catch (const std::exception& error) {
            if (interruptRequested()) throw Interrupted();
            Value refusal = Value::map();
            refusal.set("path", quotedText(path));
            refusal.set("error", quotedText(error.what()));
            refused.items.push_back(std::move(refusal));
        }
    return refused;
}

/// Names of variants with the image of another renderer, which holds for one view. @throws UsageError if all have one
std::vector<std::string> variantsOfOtherRenderers(const Study& study, const Registry& registry) {
    std::vector<std::string> names;
    TextLocation where;
    for (const Variant& variant : study.variants) {
        const std::vector<Graph::PassInfo> passes = variant.graph.passes();
        const auto other = std::ranges::find_if(
            passes, [&](const auto& pass) { return registry.find(pass.kind)->family == kOtherRenderers; });
        if (other == passes.end()) continue;
        names.push_back(variant.name);
        where = other->where;
    }
    if (names.size() == study.variants.size())
        throw UsageError(where,
                         "another renderer would have to render at each change of the view, so that there is nothing "
                         "to look at: './voxray run' renders it, and a variant without this pass can be looked at");
    return names;
}

Value vectorValue(const glm::vec3& v) {
    Value list = Value::list();
    list.items = {numberValue(v.x), numberValue(v.y), numberValue(v.z)};
    return list;
}

/// The image, or the view that is shown in place of it; its meaning is added to the answer.
ImageF displayed(const ShownState::Rendering& rendering, Value& answer) {
    const ImageSettings& settings = rendering.imageSettings;
    if (!rendering.view) return preview(rendering.images.final, settings.exposureStops, settings.tone);
    const ViewPicture picture = pictureOf(*rendering.view, settings);
    describe(answer, picture);
    return picture.display;
}

/// A line of JSON, then a PNG file, if the image could be rendered. @param shown gets a whole image. @throws
/// Interrupted
std::string answerTo(ShownState& state, const ImageRequest& request, ShownImage& shown) {
    const Clock::time_point start = Clock::now();
    Value answer = Value::map();
    std::vector<uint8_t> png;
    if (!request.isDraft()) shown.rendering.reset();
    try {
        if (!request.variant.empty()) state.select(request.variant);
        if (!request.config.isNull()) state.open(request.config);
        if (!request.isDraft()) answer.set("refused", keep(state, request.changes));
        const double setMs = millisecondsSince(start);
        const ViewChoice* view = request.view ? &*request.view : nullptr;
        ShownState::Rendering rendering = request.isDraft() ? state.draft(
                                                                  request.changes, request.shrink, [](double) {}, view)
                                                            : state.render([](double) {}, view);
        const double renderedMs = millisecondsSince(start);
        png = encodePng(displayed(rendering, answer));
        describe(answer, rendering);
        if (!request.isDraft()) answer.set("views", listViews(state));
        Value camera = Value::map();
        camera.set("position", vectorValue(rendering.camera.position));
        camera.set("target", vectorValue(rendering.camera.target));
        camera.set("fov_deg", numberValue(rendering.camera.fovDegrees));
        answer.set("camera", std::move(camera));
        answer.set("scene_size", numberValue(rendering.sceneSize));
        answer.set("set_ms", numberValue(setMs));
        answer.set("render_ms", numberValue(renderedMs - setMs));
        answer.set("png_ms", numberValue(millisecondsSince(start) - renderedMs));
        if (!request.isDraft() && !view) {
            shown.rendering = std::move(rendering);
            ++shown.number;
        }
    } catch (const std::exception& error) {
        if (interruptRequested()) throw Interrupted();
        answer.set("error", quotedText(error.what()));
    }
    answer.set("config", state.config());
    answer.set("left_out", listOf(state.culledPasses()));
    if (!request.isDraft()) {
        answer.set("variant", quotedText(state.variantId()));
        answer.set("changed", flag(state.isChanged()));
    }
    answer.set("warnings", listOf(state.warnings()));
    return answer.json(-1) + "\n" + std::string(png.begin(), png.end());
}

/// Serves the page until Ctrl-C.
void look(const LookArguments& arguments) {
    Registry registry;
    registerPasses(registry);
    const RunOptions options = completed(arguments.options, arguments);
    const InterruptScope interruptScope;
    Experiment experiment = openConfig(arguments.file, arguments, options.tracer);
    const std::vector<std::string> leftOut = variantsOfOtherRenderers(makeStudy(experiment, registry), registry);
    if (!leftOut.empty())
        fmt::print(stderr,
                   "voxray: warning: not shown, as another renderer would render at each change of the view: {}\n",
                   fmt::join(leftOut, ", "));
    InteractiveSession session(std::move(experiment), registry, options, leftOut);
    Value start = greetingOf(session);
    for (Value& variant : start.find("variants")->items) {
        const Value config = session.configOf(textOf(variant, "id"));
        variant.set("source", sourceOf(config));
        if (const Value* camera = config.find("scene")->find("camera")) variant.set("camera", *camera);
        const Value* image = config.find("image");
        if (const Value* stops = image ? image->find("exposure_stops") : nullptr) variant.set("exposure_stops", *stops);
    }
    start.set("schema", configJsonSchema(registry));
    start.set("passes", passesOf(registry));
    start.set("metrics", metricsValue());
    start.set("results", resultsHere());
    ImageRequests requests;
    const LookServer server(
        {.sourceRoot = options.sourceRoot,
         .start = start.json(-1),
         .image = [&](const std::string& body) { return requests.ask(parseImageRequest(body)); },
         .reference = [&](const std::string& body) { return requests.ask(parseReferenceRequest(body)); }},
        arguments.port);
    fmt::print("{}\nCtrl-C ends it.\n", server.address());
    std::fflush(stdout);
    std::array<ShownImage, InteractiveSession::kSides> shown;
    Clock::time_point lastImage = Clock::now();
    const auto answer = [&](const ImageRequest& request) {
        ShownImage& image = shown[request.side];
        if (request.asksReference)
            return answerAboutReference(session.isOpen(request.side) ? &session.side(request.side) : nullptr, image,
                                        request);
        if (!session.isOpen(request.side) && !request.opens() && !request.closes)
            throw UsageError("request: side {} was closed, perhaps by another page; compare again", request.side);
        std::string body = "{}\n";
        if (request.closes) {
            session.closeSecondSide();
            image.rendering.reset();
        } else {
            body = answerTo(session.side(request.side), request, image);
        }
        lastImage = Clock::now();
        return body;
    };
    bool misses = true;  // Samples of a reference
    while (!interruptRequested()) {
        const bool isQuiet = Clock::now() - lastImage >= kPatience;
        if (requests.answerNext(misses && isQuiet ? std::chrono::milliseconds(0) : kPatience, answer))
            misses = true;
        else if (misses)
            requests.work([&] { misses = session.advanceReferences(kSlice); });
    }
    requests.close();
}

}  // namespace

void addLookCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand(
        "look",
        "Serve a page for this machine's browser, on which a config is flown through and changed (docs/look.md).");
    auto arguments = std::make_shared<LookArguments>();
    command->add_option("CONFIG", arguments->file, kOpenedHelp)->required();
    command->add_option("--port", arguments->port, "Port of the loopback; default: one that is free.")
        ->type_name("N")
        ->check(CLI::Range(1, 65535));
    addConfigOptions(*command, *arguments);
    addDeviceOptions(*command, arguments->options);
    command->add_flag("--validate", arguments->options.validation,
                      "Turn Vulkan's validation layer on: its messages are shown as errors.");
    command->callback([arguments] { look(*arguments); });
}

}  // namespace voxray

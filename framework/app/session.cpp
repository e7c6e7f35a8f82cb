#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/source_root.h"
#include "app/text_values.h"
#include "config/yaml.h"
#include "experiment/interactive_session.h"
#include "passes/common/families.h"
#include "passes/path_trace/preview.h"

namespace voxray {

namespace {

constexpr int kProtocol = 1;

struct SessionArguments : ConfigArguments {
    std::filesystem::path file, images;
    bool usesStdio = false;  ///< Required, so that other channels can be added.
    RunOptions options;
};

template <typename Number>
Value numberValue(Number number) {
    return Value::fromScalar(fmt::format("{}", number));
}

/// Answers requests of docs/session.md.
class RequestHandler {
 public:
    RequestHandler(InteractiveSession& session, std::filesystem::path images)
        : session_(session), images_(std::move(images)) {}

    /// What a client is told first.
    Value greeting() {
        Value answer = Value::map(), variants = Value::list();
        answer.set("voxray", quotedText(VOXRAY_VERSION));
        answer.set("protocol", numberValue(kProtocol));
        for (const auto& [name, id] : session_.variants()) {
            Value variant = Value::map();
            variant.set("id", quotedText(id));
            variant.set("name", quotedText(name));
            variants.items.push_back(std::move(variant));
        }
        answer.set("variants", std::move(variants));
        answer.set("warnings", listOf(session_.warnings()));
        return answer;
    }

    /// @throws UsageError, Error, Interrupted.
    Value answer(const Value& request) {
        const std::string command = text(request, "command");
        Value answer = Value::map();
        if (command == "set") {
            allow(request, {"path", "value"});
            const Value* value = request.find("value");
            if (!value) throw UsageError(request.where, "set: it has no 'value'; null takes the config's entry out");
            session_.set(text(request, "path"), *value);
            answer.set("warnings", listOf(session_.warnings()));
        } else if (command == "select") {
            allow(request, {"variant"});
            session_.select(text(request, "variant"));
            answer.set("warnings", listOf(session_.warnings()));
        } else if (command == "config") {
            allow(request, {});
            answer.set("config", session_.config());
        } else if (command == "render") {
            allow(request, {});
            render(answer);
        } else if (command == "score") {
            allow(request, {});
            score(answer);
        } else {
            throw UsageError(request.where, "no command '{}'; there are config, render, score, select, set", command);
        }
        return answer;
    }

 private:
    static std::string text(const Value& request, const std::string& key) {
        const Value* value = request.find(key);
        if (!value) throw UsageError(request.where, "the request has no '{}'", key);
        return value->asString(key);
    }
    static void allow(const Value& request, const std::vector<std::string>& keys) {
        for (const auto& [key, value] : request.members)
            if (key != "id" && key != "command" && std::ranges::count(keys, key) == 0)
                throw UsageError(value.where, "{}: unknown key '{}'", text(request, "command"), key);
    }

    void render(Value& answer) {
        rendering_.reset();
        rendering_ = session_.render([](double) {});
        const FrameImages& images = rendering_->images;
        const Measurement& m = rendering_->measurement;
        Value files = Value::map(), passes = Value::list();
        const auto write = [&](const std::string& name, const ImageF& image) {
            const std::filesystem::path file = images_ / (name + ".exr");
            writeExr(file, image);
            files.set(name, quotedText(file.string()));
        };
        write(kComparedImage, images.final);
        if (images.indirect) write(kIndirectImage, *images.indirect);
        for (const PassCost& cost : m.passes) {
            Value pass = Value::map();
            pass.set("id", quotedText(cost.id));
            pass.set("phase", quotedText(cost.phase == Phase::Build ? "build" : "frame"));
            pass.set("ms", numberValue(cost.milliseconds.median));
            pass.set("rays", numberValue(cost.rays));
            pass.set("memory_bytes", numberValue(cost.memoryBytes));
            pass.set("reused",
                     Value::fromScalar(std::ranges::count(rendering_->reused, cost.id) > 0 ? "true" : "false"));
            passes.items.push_back(std::move(pass));
        }
        answer.set("images", std::move(files));
        answer.set("width", numberValue(images.final.width));
        answer.set("height", numberValue(images.final.height));
        answer.set("frame_ms", numberValue(m.frameMs.median));
        answer.set("memory_bytes", numberValue(m.memoryBytes));
        answer.set("passes", std::move(passes));
        Value values = Value::list();
        for (const ReportedValue& reported : m.values) {
            Value value = Value::map();
            value.set("pass", quotedText(reported.pass));
            value.set("name", quotedText(reported.name));
            value.set("value", numberValue(reported.value));
            values.items.push_back(std::move(value));
        }
        answer.set("values", std::move(values));
    }

    void score(Value& answer) {
        if (!rendering_) throw UsageError("score: nothing is rendered yet");
        Value scores = Value::map();
        for (const auto& [column, value] : session_.score(rendering_->images, [](double) {}).scores)
            scores.set(column, numberValue(value));
        answer.set("scores", std::move(scores));
    }

    InteractiveSession& session_;
    const std::filesystem::path images_;
    std::optional<InteractiveSession::Rendering> rendering_;  ///< The last one, if none failed since.
};

void print(const Value& line) {
    fmt::print("{}\n", line.json(-1));
    std::fflush(stdout);
}

/// Answers each line of the standard input until it ends.
void serve(RequestHandler& handler) {
    print(handler.greeting());
    size_t number = 0;
    for (std::string line; std::getline(std::cin, line);) {
        ++number;
        Value answer = Value::map(), id;
        try {
            const Value request = parseYaml(line, fmt::format("request {}", number));
            if (!request.isMap()) throw UsageError(request.where, "a request is a map with a 'command'");
            if (const Value* given = request.find("id")) id = *given;
            answer = handler.answer(request);
            answer.set("ok", Value::fromScalar("true"));
        } catch (const std::exception& error) {
            answer = Value::map();
            answer.set("ok", Value::fromScalar("false"));
            answer.set("error", quotedText(error.what()));
        }
        answer.set("id", std::move(id));
        print(answer);
    }
}

}  // namespace

void addSessionCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("session",
                                           "Keep a config open: change its values and render again, by requests in "
                                           "JSON on the standard input (docs/session.md).");
    auto arguments = std::make_shared<SessionArguments>();
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command
        ->add_flag("--stdio", arguments->usesStdio, "Requests and answers are lines of the standard input and output.")
        ->required();
    command->add_option("--images", arguments->images, "Folder that gets the images of the last render.")
        ->type_name("DIR")
        ->required();
    addConfigOptions(*command, *arguments);
    addDeviceOptions(*command, arguments->options);
    command->add_flag("--validate", arguments->options.validation,
                      "Turn Vulkan's validation layer on: its messages are errors of requests.");
    command->callback([arguments] {
        Registry registry;
        registerPasses(registry);
        RunOptions& options = arguments->options;
        options.scenes = arguments->scenes;
        options.sourceRoot = sourceRoot();
        options.previewTracer = pathTracedPreview;
        if (!options.tracer.empty()) arguments->config.assignments.push_back("tracer=" + options.tracer);
        InteractiveSession session(loadExperiment(arguments->file, arguments->config), registry, options);
        std::filesystem::create_directories(arguments->images);
        RequestHandler handler(session, std::filesystem::absolute(arguments->images));
        serve(handler);
    });
}

}  // namespace voxray

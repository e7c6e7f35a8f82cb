#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/open_config.h"
#include "app/planning.h"
#include "app/session_requests.h"
#include "app/text_values.h"
#include "config/yaml.h"
#include "passes/common/families.h"

namespace voxray {

namespace {

struct SessionArguments : ConfigArguments {
    std::filesystem::path file, images;
    std::string format = "exr";
    bool usesStdio = false;  ///< Required, so that other channels can be added.
    RunOptions options;
};

void print(const Value& line) {
    fmt::print("{}\n", line.json(-1));
    std::fflush(stdout);
}

/// Answers each line of the standard input until it ends.
void serve(RequestHandler& handler, const Value& greeting) {
    print(greeting);
    size_t number = 0;
    for (std::string line; std::getline(std::cin, line);) {
        ++number;
        Value answer = Value::map(), id;
        try {
            const Value request = parseYaml(line, fmt::format("request {}", number));
            if (!request.isMap()) throw UsageError(request.where, "a request is a map with a 'command'");
            if (const Value* given = request.find("id")) id = *given;
            answer = handler.answer(request);
            answer.set("ok", flag(true));
        } catch (const std::exception& error) {
            answer = Value::map();
            answer.set("ok", flag(false));
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
    command->add_option("CONFIG", arguments->file, kOpenedHelp)->required();
    command
        ->add_flag("--stdio", arguments->usesStdio, "Requests and answers are lines of the standard input and output.")
        ->required();
    command->add_option("--images", arguments->images, "Folder that gets the images of the last render.")
        ->type_name("DIR")
        ->required();
    command->add_option("--format", arguments->format, "Of images: EXR files, or NumPy's, which are written faster.")
        ->type_name("exr|npy")
        ->check(CLI::IsMember({"exr", "npy"}))
        ->capture_default_str();
    addConfigOptions(*command, *arguments);
    addDeviceOptions(*command, arguments->options);
    command->add_flag("--validate", arguments->options.validation,
                      "Turn Vulkan's validation layer on: its messages are errors of requests.");
    command->callback([arguments] {
        Registry registry;
        registerPasses(registry);
        const RunOptions options = completed(arguments->options, *arguments);
        InteractiveSession session(openConfig(arguments->file, *arguments, options.tracer), registry, options);
        std::filesystem::create_directories(arguments->images);
        RequestHandler handler(session.side(0),
                               {std::filesystem::absolute(arguments->images), arguments->format == "npy"});
        serve(handler, greetingOf(session));
    });
}

}  // namespace voxray

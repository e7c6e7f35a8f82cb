#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/source_root.h"
#include "base/error.h"
#include "experiment/report_process.h"

namespace voxray {

namespace {

struct ParetoArguments {
    std::vector<std::string> results;
    std::string out = "pareto.html";
    std::string error = "nrmse";
    std::string light = "indirect";
};

void compareMethods(const ParetoArguments& arguments) {
    std::vector<std::string> words{"--out",   arguments.out,   "--error", arguments.error,
                                   "--light", arguments.light, "--"};
    words.insert(words.end(), arguments.results.begin(), arguments.results.end());
    const ScriptEnd end = runReportScript(sourceRoot(), "make_pareto.py", words, OnInterrupt::End);
    if (end.status == 2) throw UsageError("{}", end.lastLine);
    if (end.status != 0) throw Error("{}", end.lastLine);
    fmt::print("{}\n{}\n", arguments.out,
               std::filesystem::path(arguments.out).replace_extension(".csv").string());
}

}  // namespace

void addParetoCommand(CLI::App& app, int&) {
    auto arguments = std::make_shared<ParetoArguments>();
    CLI::App* command =
        app.add_subcommand("pareto",
                           "Chart the methods of many runs, speed against accuracy: which are on the front, "
                           "scene by scene, which "
                           "are beaten everywhere, and what each saves over filtered path tracing.");
    command->add_option("RESULTS", arguments->results, "Results folders of runs, also of several machines.")
        ->required()
        ->type_name("DIR");
    command->add_option("--out", arguments->out, "The page; a table with all numbers gets its name and .csv.")
        ->capture_default_str()
        ->type_name("FILE.html");
    command->add_option("--error", arguments->error, "Metric that methods are compared by.")
        ->capture_default_str();
    command->add_option("--light", arguments->light, "indirect or total.")->capture_default_str();
    command->callback([arguments] { compareMethods(*arguments); });
}

}  // namespace voxray

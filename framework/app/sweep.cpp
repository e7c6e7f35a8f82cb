#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/planning.h"
#include "base/error.h"
#include "experiment/parts.h"
#include "experiment/workflow.h"

namespace voxray {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEngine = "snakemake";

struct SweepArguments : ConfigArguments {
    fs::path file;
    RunOptions options;
    WorkflowSettings workflow;
    std::optional<uint32_t> referenceParts;
    bool slurm = false, print = false;
    std::string engineProfile;
    unsigned jobs = 100, retries = 2;
    std::vector<std::string> engine;  ///< More of its options.
};

/// A word as a shell reads it.
std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

/// What `run` takes for each part, as it was given here.
std::vector<std::string> runArguments(const SweepArguments& arguments) {
    std::vector<std::string> words{arguments.file.string()};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) words.insert(words.end(), {option, value});
    };
    add("--profile", arguments.config.profile);
    for (const std::string& assignment : arguments.config.assignments) add("--set", assignment);
    add("--scenes", arguments.scenes.string());
    add("--device", arguments.options.deviceName);
    add("--tracer", arguments.options.tracer);
    return words;
}

/// Writes the experiment's workflow. @return its folder, absolute, and its lock.
std::pair<fs::path, std::unique_ptr<ProcessLock>> writeWorkflow(SweepArguments& arguments,
                                                                PreparedExperiment& prepared) {
    WorkflowSettings& workflow = arguments.workflow;
    if (workflow.program.empty()) workflow.program = quoted(fs::read_symlink("/proc/self/exe").string());
    workflow.arguments = runArguments(arguments);
    workflow.from = fs::current_path();
    workflow.referenceParts = arguments.referenceParts
                                  ? *arguments.referenceParts
                                  : std::min(referenceSamples(prepared), workflow.cores.value_or(1));
    const RunOptions& options = arguments.options;
    const std::string& name = prepared.experiment().setup.general.name;
    const fs::path out = fs::absolute(options.out.empty() ? fs::path("results") / name : options.out);
    return {workflowFolder(out), writeWorkflow(prepared, out, workflow)};
}

/// The engine's command line.
std::vector<std::string> engineWords(const SweepArguments& arguments, const fs::path& folder) {
    // A mark is touched once its part is done, so it is whole, and its age tells nothing
    std::vector<std::string> words{kEngine,
                                   "--snakefile",
                                   (folder / "Snakefile").string(),
                                   "--directory",
                                   folder.string(),
                                   "--nolock",
                                   "--rerun-incomplete",
                                   "--rerun-triggers",
                                   "mtime",
                                   "--drop-metadata",
                                   "--scheduler",
                                   "greedy",
                                   "--keep-going",
                                   "--retries",
                                   std::to_string(arguments.retries),
                                   "--show-failed-logs",
                                   "--quiet",
                                   "rules"};
    const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    constexpr const char* kSeconds = "60";  // For which a network file system may hide a new file.
    if (arguments.workflow.cores) {
        const auto pages = uint64_t(::sysconf(_SC_PHYS_PAGES)), bytes = uint64_t(::sysconf(_SC_PAGESIZE));
        add({"--cores", std::to_string(*arguments.workflow.cores), "--resources",
             fmt::format("mem_mb={}", pages * bytes >> 20)});
    } else if (arguments.slurm) {
        add({"--slurm", "--jobs", std::to_string(arguments.jobs), "--latency-wait", kSeconds});
    } else {
        add({"--profile", arguments.engineProfile, "--latency-wait", kSeconds});
    }
    words.insert(words.end(), arguments.engine.begin(), arguments.engine.end());
    return words;
}

/// Hands over to the engine, which runs this program for each part; returns only to print its command line.
void sweep(SweepArguments arguments) {
    const int places = int(arguments.workflow.cores.has_value()) + int(arguments.slurm) +
                       int(!arguments.engineProfile.empty());
    if (places != 1)
        throw UsageError("sweep: say where it runs, by one of --cores, --slurm and --snakemake-profile");
    fs::path folder;
    std::unique_ptr<ProcessLock> lock;
    planExperiment(arguments.file, arguments, arguments.options, [&](PreparedExperiment& prepared) {
        std::tie(folder, lock) = writeWorkflow(arguments, prepared);
    });
    std::vector<std::string> words = engineWords(arguments, folder);
    if (arguments.print) {
        std::vector<std::string> shellWords;
        for (const std::string& word : words) shellWords.push_back(quoted(word));
        fmt::print("{}\n", fmt::join(shellWords, " "));
        return;
    }

    // Its executor for Slurm wants to know whose jobs it looks for
    if (const passwd* user = ::getpwuid(::geteuid())) ::setenv("USER", user->pw_name, 0);
    lock->keepAcrossExec();
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execvp(kEngine, pointers.data());
    if (errno == ENOENT)
        throw Error("{} is not installed; on Debian, scripts/setup-debian.sh sweep installs it", kEngine);
    throw Error("can't run {}: {}", kEngine, std::strerror(errno));
}

void addPlaceOptions(CLI::App& command, SweepArguments& arguments) {
    WorkflowSettings& workflow = arguments.workflow;
    command.add_option("--cores", workflow.cores, "Run on this machine, on so many cores.")
        ->type_name("N")
        ->check(CLI::Range(1u, 1u << 16));
    command.add_flag("--slurm", arguments.slurm, "Run as jobs of Slurm.");
    command.add_option("--partition", workflow.partition, "Slurm's partition. Default: its own.")
        ->type_name("NAME")
        ->needs("--slurm");
    command.add_option("--account", workflow.account, "Slurm's account. Default: the user's own.")
        ->type_name("NAME")
        ->needs("--slurm");
    command.add_option("--jobs", arguments.jobs, "How many jobs Slurm has at once.")
        ->type_name("N")
        ->needs("--slurm")
        ->check(CLI::Range(1u, 1u << 16))
        ->capture_default_str();
    command
        .add_option("--snakemake-profile", arguments.engineProfile,
                    "Run as this profile of Snakemake says: another batch system, a cloud.")
        ->type_name("NAME");
}

void addPartOptions(CLI::App& command, SweepArguments& arguments) {
    WorkflowSettings& workflow = arguments.workflow;
    command
        .add_option(
            "--reference-parts", arguments.referenceParts,
            "How many parts each reference's samples are divided into. Default: one for each of --cores, "
            "else 1.")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20));
    command.add_flag("--untimed", workflow.untimed,
                     "Times don't matter: variants share machines, and a warning on the page says so.");
    command.add_option("--threads", workflow.threads, "Threads of each part that shares a machine.")
        ->type_name("N")
        ->check(CLI::Range(1u, 1u << 16))
        ->capture_default_str();
    command.add_option("--retries", arguments.retries, "How often a part that failed is tried again.")
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--paths-per-second", workflow.pathsPerSecond,
                    "Of one thread, for the time limits of references.")
        ->check(CLI::PositiveNumber)
        ->default_val(100000);
    command
        .add_option("--seconds-per-run", workflow.secondsPerRun,
                    "Of a variant's graph, built or run for one frame, for the time limits of variants.")
        ->check(CLI::PositiveNumber)
        ->default_val(60);
}

}  // namespace

void addSweepCommand(CLI::App& app, int&) {
    auto arguments = std::make_shared<SweepArguments>();
    CLI::App* command =
        app.add_subcommand("sweep",
                           "Run the parts of an experiment at once, by Snakemake: on this machine's cores, "
                           "on Slurm, or wherever a "
                           "profile of Snakemake says. Started again, it goes on with what is left.");
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command->add_option("SNAKEMAKE", arguments->engine, "After --: more options for Snakemake.");
    command->add_option("--out", arguments->options.out, "Results folder; default results/<experiment>.")
        ->type_name("DIR");
    addPlaceOptions(*command, *arguments);
    addPartOptions(*command, *arguments);
    command
        ->add_option("--program", arguments->workflow.program,
                     "What starts Voxray in a job, as in 'apptainer exec voxray.sif voxray'. Default: this "
                     "program.")
        ->type_name("COMMAND");
    command->add_flag("--print", arguments->print,
                      "Print Snakemake's command line, in place of starting it.");
    addConfigOptions(*command, *arguments);
    addDeviceOptions(*command, arguments->options);
    command->callback([arguments] { sweep(*arguments); });
}

}  // namespace voxray

#include <memory>
#include <string>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/orchestration_process.h"

/// Options of the commands that framework/orchestration implements.
namespace voxray {

namespace {

/// Variables to which common options are bound. They are not read, see runOrchestration().
struct UnusedValues : ConfigArguments {
    RunOptions run;
};

CLI::App* addOrchestrationCommand(CLI::App& app, const std::string& name, const std::string& help,
                                  const std::shared_ptr<UnusedValues>& values = {}) {
    CLI::App* command = app.add_subcommand(name, help);
    command->callback([command, values] { runOrchestration(*command); });
    return command;
}

CLI::Option* addText(CLI::App& command, const std::string& name, const std::string& type, const std::string& help) {
    return command.add_option(name, help)->type_name(type);
}

CLI::Option* addTexts(CLI::App& command, const std::string& name, const std::string& type, const std::string& help) {
    return addText(command, name, type, help)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// Without it CLI11's overloads are ambiguous for a literal.
CLI::Option* addFlag(CLI::App& command, const std::string& name, const std::string& help) {
    return command.add_flag(name, help);
}

CLI::Option* addCount(CLI::App& command, const std::string& name, const std::string& help, int most = 1 << 16) {
    return addText(command, name, "N", help)->check(CLI::Range(1, most));
}

CLI::Option* addConfig(CLI::App& command) {
    return addText(command, "CONFIG", "TEXT", "Config file.")->required();
}

void addExecutorOptions(CLI::App& command) {
    addCount(command, "--cores", "Run on this machine, on so many cores.");
    addFlag(command, "--slurm", "Run as jobs of Slurm.");
    addText(command, "--partition", "NAME", "Slurm's partition. Default: its own.")->needs("--slurm");
    addText(command, "--account", "NAME", "Slurm's account. Default: the user's own.")->needs("--slurm");
    addCount(command, "--jobs", "How many jobs Slurm has at once.")->needs("--slurm")->default_str("100");
    addText(command, "--snakemake-profile", "NAME",
            "Run as this profile of Snakemake says: another batch system, a cloud.");
}

void addPartOptions(CLI::App& command) {
    addCount(command, "--reference-parts",
             "How many parts each reference's samples are divided into. Default: one for each of --cores, else 1.",
             1 << 20);
    addFlag(command, "--untimed", "Times don't matter: variants share machines, and a warning on the page says so.");
    addCount(command, "--threads", "Threads of each part that shares a machine.")->default_str("1");
    addText(command, "--retries", "N", "How often a part that failed is tried again.")
        ->check(CLI::Range(0, 1 << 16))
        ->default_str("2");
    addText(command, "--paths-per-second", "FLOAT", "Of one thread, for the time limits of references.")
        ->check(CLI::PositiveNumber)
        ->default_str("100000");
    addText(command, "--seconds-per-run", "FLOAT",
            "Of a variant's graph, built or run for one frame, for the time limits of variants.")
        ->check(CLI::PositiveNumber)
        ->default_str("60");
}

}  // namespace

void addTuneCommand(CLI::App& app, int&) {
    const auto values = std::make_shared<UnusedValues>();
    CLI::App& command = *addOrchestrationCommand(app, "tune",
                                                 "Search the variants of a config's sweep "
                                                 "for the cheapest one whose error meets a target: "
                                                 "small images first, the best of them at the config's own.",
                                                 values);
    addConfig(command);
    addTexts(command, "--target", "NAME=VALUE",
             "Column of results.csv and the value to meet, as in indirect_relmse=0.02. May be given many times.")
        ->required();
    addText(command, "--minimize", "TEXT", "What is to be cheap: ms or rays (of one build and one frame) or bytes.")
        ->check(CLI::IsMember({"ms", "rays", "bytes"}))
        ->default_str("ms");
    addTexts(command, "--vary", "ID.PARAMETER",
             "A pass's parameter that is searched besides the sweep, over halves and doubles of its value, "
             "as in gather.rays. May be given many times.");
    addText(command, "--budget", "FLOAT", "What trials may cost, in variants of mean cost; 0: a fifth of the sweep.")
        ->check(CLI::NonNegativeNumber)
        ->default_str("0");
    addFlag(command, "--every", "Run the whole sweep, too, and compare: how good the choice is, what it saved.");
    addFlag(command, "--resume", "Keep the trials that an earlier search finished.");
    addDeviceOptions(command, values->run);
    addText(command, "--out", "DIR", "Folder of trials; default results/tune_<experiment>.");
    addSweepOptions(command, *values);
}

void addExplainCommand(CLI::App& app, int&) {
    const auto values = std::make_shared<UnusedValues>();
    CLI::App& command = *addOrchestrationCommand(app, "explain",
                                                 "Say where a config's error comes from: "
                                                 "render it with each stage swapped for an exact counterpart, "
                                                 "and give each its part of the error of the indirect light.",
                                                 values);
    addConfig(command);
    addText(command, "--variant", "NAME",
            "Which variant of the config's sweep is explained, by its name in results.csv or the end of it, "
            "as in lookup for cornell-lookup.");
    addSweepOptions(command, *values);
    addRunOptions(command, values->run, "Results folder; default results/explain_<experiment>.");
}

void addStabilityCommand(CLI::App& app, int&) {
    const auto values = std::make_shared<UnusedValues>();
    CLI::App& command =
        *addOrchestrationCommand(app, "stability",
                                 "Show where methods fail: run each in scenes that provoke one failure each (leaks, "
                                 "lost energy, flicker ...), and hold every result against its limit.",
                                 values);
    addText(command, "METHOD", "TEXT", "Methods of the matrix; all by default.")->expected(1, -1)->allow_extra_args();
    addTexts(command, "--scenario", "NAME",
             "Run this scene of the matrix, and the first of its profile. May be given many times.");
    addText(command, "--config", "CONFIG",
            "The matrix, its limits next to it in a .csv of the same name; default configs/stability/matrix.yaml.");
    addFlag(command, "--remedies",
            "Run what fails again with finer settings, one kind at a time, and say which of them lowers each error; "
            "they stand next to the matrix, in a file that ends in _remedies.json.");
    addText(
        command, "--export", "DIR",
        "Run nothing: write the scenes of single images into DIR for another renderer, as glTF with side-cars, and a "
        "matrix.yaml that scores its images by their limits.");
    addSweepOptions(command, *values);
    addRunOptions(command, values->run,
                  "Folder of the tables and of a results folder for each profile; default results/stability.");
}

void addSweepCommand(CLI::App& app, int&) {
    const auto values = std::make_shared<UnusedValues>();
    CLI::App& command = *addOrchestrationCommand(
        app, "sweep",
        "Run the parts of an experiment at once, by Snakemake: on this machine's cores, on Slurm, "
        "or wherever a profile of Snakemake says. Started again, it goes on with what is left.",
        values);
    addConfig(command);
    addText(command, "SNAKEMAKE", "TEXT", "After --: more options for Snakemake.")->expected(1, -1)->allow_extra_args();
    addText(command, "--out", "DIR", "Results folder; default results/<experiment>.");
    addExecutorOptions(command);
    addPartOptions(command);
    addText(command, "--program", "COMMAND",
            "What starts Voxray in a job, as in 'apptainer exec voxray.sif voxray'. Default: this program.");
    addFlag(command, "--print", "Print Snakemake's command line, in place of starting it.");
    addSweepOptions(command, *values);
    addDeviceOptions(command, values->run);
}

void addParetoCommand(CLI::App& app, int&) {
    CLI::App& command = *addOrchestrationCommand(app, "pareto",
                                                 "Chart the methods of many runs, speed against accuracy: "
                                                 "which are on the front, scene by scene, which are beaten everywhere, "
                                                 "and what each saves over filtered path tracing.");
    addText(command, "RESULTS", "DIR", "Results folders of runs, also of several machines.")
        ->required()
        ->expected(1, -1)
        ->allow_extra_args();
    addText(command, "--out", "FILE.html", "The page; a table with all numbers gets its name and .csv.")
        ->default_str("pareto.html");
    addText(command, "--error", "TEXT", "Metric that the page shows first and that figures are of.")
        ->default_str("nrmse");
    addText(command, "--light", "TEXT", "indirect or total.")
        ->check(CLI::IsMember({"indirect", "total"}))
        ->default_str("indirect");
    addFlag(command, "--no-images", "Leave out images and error maps, for a smaller page.");
    addText(command, "--figures", "DIR",
            "Folder for figures of a paper: the matrix and each scene's chart as SVG and PDF, with their data.");
}

void addPackCommand(CLI::App& app, int&) {
    const auto values = std::make_shared<UnusedValues>();
    CLI::App& command = *addOrchestrationCommand(app, "pack",
                                                 "Run a config and write a file with which others can check its "
                                                 "results: config, hashes and licences of scenes, results, "
                                                 "references, and what each score may differ by.",
                                                 values);
    addConfig(command);
    addText(command, "-o,--out", "FILE.zip", "The file to write; default <experiment>.zip.");
    addText(command, "--results", "DIR", "Results folder of the run; default results/<experiment>.");
    addFlag(command, "--resume", "Keep what an earlier run of the same experiment finished.");
    addFlag(command, "--with-scenes", "Pack all scenes. Without: those of at most 1 MiB whose file states a licence.");
    addTexts(command, "--licence", "SCENE=TEXT",
             "Licence of a scene, by its name in the config, where its file states none. May be given many times.");
    addDeviceOptions(command, values->run);
    addFlag(command, "--quiet", "Print nothing of the run but errors.");
    addSweepOptions(command, *values);
}

void addVerifyCommand(CLI::App& app, int&) {
    const auto values = std::make_shared<UnusedValues>();
    CLI::App& command = *addOrchestrationCommand(app, "verify",
                                                 "Run a packed study again, its references too, and say of each "
                                                 "score whether it is the same, within its tolerance, or not.",
                                                 values);
    addText(command, "PACK", "FILE.zip", "What 'voxray pack' wrote.")->required();
    addText(command, "--out", "DIR", "Results folder of the run; by default it is removed at the end.");
    addFlag(command, "--resume", "Keep what an earlier run into this folder finished.")->needs("--out");
    addText(command, "--scenes", "DIR", "Folder in which scene files are looked for that are not in the pack.")
        ->check(CLI::ExistingDirectory.description(""));
    addDeviceOptions(command, values->run);
    addFlag(command, "--quiet", "Print no claim that is confirmed.");
}

}  // namespace voxray

#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "experiment/runner.h"

namespace voxray {

/// Common arguments of all commands that read a config and its scene.
struct ConfigArguments {
    ConfigOptions config;
    std::vector<std::string> only;  ///< "axis=value" of --only: selected values of the sweep.
    std::filesystem::path scenes;
};

inline void addConfigOptions(CLI::App& command, ConfigArguments& arguments) {
    command.add_option("--profile", arguments.config.profile, "Apply this block of the config's profiles.");
    command
        .add_option("--set", arguments.config.assignments,
                    "PATH=VALUE: change a key of the config or a pass's parameter, "
                    "as in image.width=320 or voxelize.resolution=64. May be given many times.")
        ->type_name("PATH=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--scenes", arguments.scenes, "Folder in which scene files are looked for first.")
        ->type_name("DIR")
        ->check(CLI::ExistingDirectory.description(""));
}

/// The same of all commands that read the sweep, too.
inline void addSweepOptions(CLI::App& command, ConfigArguments& arguments) {
    addConfigOptions(command, arguments);
    command
        .add_option("--only", arguments.only,
                    "AXIS=VALUE: run this value of an axis of the sweep, and others that are named so. "
                    "May be given many times.")
        ->type_name("AXIS=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// Rejects an output file whose extension is not that of its format.
inline CLI::Validator endsWith(const std::string& ending) {
    return CLI::Validator(
        [ending](const std::string& name) {
            return name.ends_with(ending) ? std::string() : fmt::format("'{}' does not end in {}", name, ending);
        },
        "");
}

/// Common options of all commands that use a device.
inline void addDeviceOptions(CLI::App& command, RunOptions& options) {
    command
        .add_option("--device", options.deviceName, "Part of a Vulkan device's name; default: the best that qualifies.")
        ->type_name("NAME");
    command
        .add_option("--tracer", options.tracer,
                    "Ray tracer in place of the config's: auto, ray_query, ray_pipeline or embree.")
        ->type_name("NAME");
}

/// Common options of all commands that render variants.
inline void addRunOptions(CLI::App& command, RunOptions& options, const std::string& outHelp) {
    command.add_option("--out", options.out, outHelp)->type_name("DIR");
    addDeviceOptions(command, options);
    command.add_flag("--resume", options.resume, "Keep what an earlier run of the same experiment finished.");
    command.add_flag("--dry-run", options.dryRun, "Print variants, passes and known memory; render nothing.");
    command.add_flag("--quiet", options.quiet, "Print nothing but errors.");
}

}  // namespace voxray

#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "config/config.h"

namespace voxray {

/// What every command that reads a config and its scene takes besides.
struct ConfigArguments {
    ConfigOptions config;
    std::filesystem::path scenes;
};

inline void addConfigOptions(CLI::App& command, ConfigArguments& arguments) {
    command.add_option("--profile", arguments.config.profile, "Apply this block of the config's profiles.");
    command
        .add_option("--set", arguments.config.assignments,
                    "PATH=VALUE: change a key of the config or a pass's parameter, as in image.width=320 or "
                    "voxelize.resolution=64. May be given many times.")
        ->type_name("PATH=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--scenes", arguments.scenes, "Folder in which scene files are looked for first.")
        ->type_name("DIR");
}

}  // namespace voxray

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/planning.h"
#include "app/source_root.h"
#include "app/text_values.h"
#include "experiment/results.h"
#include "experiment/scene_files.h"
#include "passes/common/families.h"

namespace voxray {

namespace {

struct PlanArguments : ConfigArguments {
    std::filesystem::path file;
};

Value variantValue(const Variant& variant) {
    Value map = Value::map(), locations = Value::list();
    for (const Value& entry : variant.setup.graph.items) locations.items.push_back(quotedText(entry.where.str()));
    map.set("id", quotedText(variant.id));
    map.set("name", quotedText(variant.name));
    map.set("values", listOf(variant.values));
    map.set("config", variant.config);
    map.set("places", locations);
    map.set("left_out", listOf(variant.culledPasses));
    return map;
}

/// The JSON that docs/programs.md describes.
Value planValue(const Study& study, const PlanArguments& arguments) {
    const Experiment& experiment = study.experiment;
    Value plan = Value::map(), axes = Value::list(), variants = Value::list();
    for (const auto& [path, values] : experiment.sweep.members) {
        Value axis = Value::map();
        axis.set("path", quotedText(path));
        axis.set("place", quotedText(values.where.str()));
        axes.items.push_back(std::move(axis));
    }
    for (const Variant& variant : study.variants) variants.items.push_back(variantValue(variant));
    plan.set("name", quotedText(experiment.setup.general.name));
    plan.set("place", quotedText(experiment.config.where.str()));
    plan.set("profiles", listOf(profileNames(arguments.file)));
    plan.set("config", experiment.config);
    plan.set("reference", study.reference.isNull() ? Value() : study.reference.items.front());
    std::vector<std::string> folders;
    for (const auto& folder : sceneFolders(arguments.scenes, sourceRoot(), arguments.file))
        folders.push_back(folder.string());
    plan.set("scene_folders", listOf(folders));
    plan.set("columns", listOf(numberColumns(experiment.measure)));
    plan.set("axes", std::move(axes));
    plan.set("variants", std::move(variants));
    return plan;
}

}  // namespace

void addPlanCommand(CLI::App& app, int&) {
    auto arguments = std::make_shared<PlanArguments>();
    CLI::App* command = app.add_subcommand("plan",
                                           "Print as JSON, for other programs, what a config asks for: "
                                           "its variants with their values and graphs, the sweep's axes, "
                                           "the columns of results.csv.");
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    addSweepOptions(*command, *arguments);
    command->callback([arguments] {
        Registry registry;
        registerPasses(registry);
        const Study study = loadStudy(arguments->file, arguments->config, arguments->only, registry);
        fmt::print("{}\n", planValue(study, *arguments).json(-1));
    });
}

}  // namespace voxray

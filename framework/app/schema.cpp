#include <fmt/format.h>

#include "app/commands.h"
#include "experiment/config_schema.h"
#include "passes/common/families.h"

namespace voxray {

void addSchemaCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of a config, for editors.");
    command->callback([] {
        Registry registry;
        registerPasses(registry);
        fmt::print("{}\n", configJsonSchema(registry).json());
    });
}

}  // namespace voxray

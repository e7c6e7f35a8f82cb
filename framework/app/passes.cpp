#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/commands.h"
#include "graph/registry.h"
#include "passes/register_passes.h"

namespace voxray {

namespace {

void printList(const Registry& registry) {
    size_t widest = 0;
    for (const PassKind& kind : registry.kinds()) widest = std::max(widest, kind.name.size());
    for (const PassKind& kind : registry.kinds())
        fmt::print("{:{}}  {}\n", kind.name, widest, kind.help.substr(0, kind.help.find('\n')));
    fmt::print("\nvoxray passes NAME tells a pass's ports and parameters.\n");
}

void printPorts(const PassKind& kind, bool outputs) {
    for (const PortInfo& port : kind.ports) {
        if (port.output != outputs) continue;
        fmt::print("  {:<20} {}{}\n", port.name, port.help, port.optional ? " (optional)" : "");
    }
}

std::string rangeOf(const ParameterDoc& parameter) {
    if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, " | "));
    if (!parameter.min.empty())
        return fmt::format("{} {} to {}", parameter.type, parameter.min, parameter.max);
    return parameter.type;
}

void printPass(const PassKind& kind) {
    fmt::print("{}\n  {}\n", kind.name, kind.help);
    fmt::print("\nInputs:\n");
    printPorts(kind, false);
    fmt::print("\nOutputs:\n");
    printPorts(kind, true);
    fmt::print("\nParameters (default; range):\n");
    for (const ParameterDoc& parameter : kind.parameters) {
        const std::string defaults = parameter.defaults.empty() ? "''" : parameter.defaults;
        fmt::print("  {:<20} {}  ({}; {})\n", parameter.name, parameter.help, defaults, rangeOf(parameter));
    }
    if (kind.parameters.empty()) fmt::print("  none\n");
}

}  // namespace

void addPassesCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("passes", "List passes, or one pass's ports and parameters.");
    auto name = std::make_shared<std::string>();
    command->add_option("NAME", *name, "A pass.");
    command->callback([name] {
        Registry registry;
        registerPasses(registry);
        if (name->empty())
            printList(registry);
        else
            printPass(registry.require(*name, {}));
    });
}

}  // namespace voxray

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>

#include "app/commands.h"
#include "graph/registry.h"
#include "passes/common/families.h"

namespace voxray {

namespace {

constexpr size_t kTextWidth = 100;

/// Breaks a text into lines of at most kTextWidth columns, and indents all but the first one.
std::string wrapped(const std::string& text, size_t firstColumn, size_t indent) {
    std::string out;
    size_t column = firstColumn;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!out.empty() && column + word.size() + 1 > kTextWidth) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!out.empty()) {
            out += ' ';
            ++column;
        }
        out += word;
        column += word.size();
    }
    return out;
}

void printList(const Registry& registry, bool withExperiments) {
    size_t widest = 0;
    for (const PassKind& kind : registry.kinds()) widest = std::max(widest, kind.name.size());
    for (const Family& family : kFamilies) {
        if (family.isForExperiments && !withExperiments) continue;
        fmt::print("{}: {}\n", family.folder, family.title);
        for (const PassKind& kind : registry.kinds()) {
            if (kind.family != family.folder) continue;
            const std::string firstSentence = kind.help.substr(0, kind.help.find(". "));
            fmt::print("  {:{}}  {}\n", kind.name, widest, firstSentence);
        }
    }
    fmt::print("\nvoxray passes NAME tells a pass's ports and parameters.\n");
    if (!withExperiments) fmt::print("voxray passes --experiments adds those that measure for experiments.\n");
}

/// Prints a name and its description in two columns.
void printEntry(const std::string& name, const std::string& text) {
    constexpr size_t kColumn = 22;
    fmt::print("  {:<{}} {}\n", name, kColumn - 3, wrapped(text, kColumn, kColumn));
}

void printPorts(const PassKind& kind, bool outputs) {
    bool any = false;
    for (const PortDoc& port : kind.ports) {
        if (port.output != outputs) continue;
        const std::string with = port.with.empty() ? "" : " (with " + port.with + ")";
        printEntry(port.name, port.help + (port.optional ? " (optional)" : "") + with);
        any = true;
    }
    if (!any) fmt::print("  none\n");
}

std::string rangeOf(const ParameterDoc& parameter) {
    if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, " | "));
    if (!parameter.min.empty()) return fmt::format("{} from {} to {}", parameter.type, parameter.min, parameter.max);
    return parameter.type;
}

void printPass(const PassKind& kind) {
    fmt::print("{}\n  {}\n", kind.name, wrapped(kind.help, 2, 2));
    fmt::print("\nInputs:\n");
    printPorts(kind, false);
    fmt::print("\nOutputs:\n");
    printPorts(kind, true);
    fmt::print("\nParameters:\n");
    for (const ParameterDoc& parameter : kind.parameters) {
        const std::string defaults = parameter.defaults.empty() ? "''" : parameter.defaults;
        printEntry(parameter.name, fmt::format("{} Default {}; {}.", parameter.help, defaults, rangeOf(parameter)));
    }
    if (kind.parameters.empty()) fmt::print("  none\n");
}

}  // namespace

void addPassesCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("passes", "List passes, or one pass's ports and parameters.");
    auto name = std::make_shared<std::string>();
    command->add_option("NAME", *name, "A pass.");
    auto withExperiments = std::make_shared<bool>(false);
    command->add_flag("--experiments", *withExperiments, "List passes that measure for experiments, too.")
        ->excludes("NAME");
    command->callback([name, withExperiments] {
        Registry registry;
        registerPasses(registry);
        if (name->empty())
            printList(registry, *withExperiments);
        else
            printPass(registry.require(*name, {}));
    });
}

}  // namespace voxray

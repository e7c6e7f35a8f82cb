#include "app/orchestration_process.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "app/source_root.h"
#include "base/error.h"
#include "base/value.h"
#include "experiment/report_process.h"

namespace voxray {

namespace {

Value stringValue(const std::string& word) {
    return Value::fromScalar(word, true);
}

/// The value that was given for an option, else its default; null if there is none.
Value valueOf(const CLI::Option& option) {
    const bool isList =
        option.get_items_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    if (option.get_items_expected_max() == 0) return Value::fromScalar(option.count() > 0 ? "true" : "false");
    if (isList) {
        Value list = Value::list();
        for (const std::string& word : option.results()) list.items.push_back(stringValue(word));
        return list;
    }
    if (option.count() > 0) return stringValue(option.results().back());
    return option.get_default_str().empty() ? Value() : stringValue(option.get_default_str());
}

}  // namespace

void runOrchestration(const CLI::App& command) {
    Value options = Value::map();
    for (const CLI::Option* option : command.get_options())
        if (option != command.get_help_ptr())
            options.set(option->get_lnames().empty() ? option->get_name() : option->get_lnames()[0], valueOf(*option));
    std::vector<std::string> words{kPython,
                                   "-B",
                                   (sourceRoot() / "framework/orchestration").string(),
                                   command.get_name(),
                                   std::filesystem::read_symlink("/proc/self/exe").string(),
                                   options.json(-1)};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(kPython, pointers.data());
    throw Error("can't run {}: {}", kPython, std::strerror(errno));
}

}  // namespace voxray

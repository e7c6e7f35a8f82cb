#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "base/parameter.h"
#include "base/suggest.h"

namespace voxray {
namespace {

namespace fs = std::filesystem;

/// A path that a value names, relative to its file.
fs::path besideFile(const Value& value, const std::string& name) {
    return fs::path(value.where.file).parent_path() / name;
}

std::string contentHash(const fs::path& path) {
    const std::vector<uint8_t> bytes = readFile(path);
    return Hasher().add(bytes.data(), bytes.size()).hex();
}

class TextFileType final : public ParameterType {
 public:
    const char* name() const override { return "string"; }

    void read(void* target, const Value& value, const std::string& what) const override {
        TextFile& file = *static_cast<TextFile*>(target);
        file = {value.asString(what), {}, {}};
        if (file.name.empty()) return;
        const fs::path path = besideFile(value, file.name);
        file.path = path.lexically_normal().string();
        if (!fs::is_regular_file(path))
            throw UsageError(value.where, "{}: no file '{}'{}", what, file.path, didYouMeanFile(path));
        file.text = readTextFile(path);
    }

    std::string text(const void* field) const override { return static_cast<const TextFile*>(field)->name; }
    /// The file's text: manifests keep what was run.
    Value value(const void* field) const override {
        return Value::fromScalar(static_cast<const TextFile*>(field)->text, true);
    }
};

class ProgramCommandType final : public ParameterType {
 public:
    const char* name() const override { return "words"; }

    void read(void* target, const Value& value, const std::string& what) const override {
        ProgramCommand& command = *static_cast<ProgramCommand*>(target);
        command = {{}, value.where.file};
        if (!value.isList())
            throw UsageError(value.where, "{}: expected a list of words, as in [python3, render.py], not '{}'", what,
                             value.text());
        for (const Value& word : value.items) command.words.push_back(word.asString(what));
    }

    std::string text(const void* field) const override {
        return list(*static_cast<const ProgramCommand*>(field)).text();
    }
    /// Words that name a file are followed by its hash: manifests tell what was run.
    Value value(const void* field) const override {
        const ProgramCommand& command = *static_cast<const ProgramCommand*>(field);
        Value words = list(command);
        for (Value& word : words.items) {
            const fs::path path = fs::path(command.file).parent_path() / word.scalar;
            std::error_code ignored;
            if (fs::is_regular_file(path, ignored)) word.scalar += " (" + contentHash(path) + ")";
        }
        return words;
    }

 private:
    static Value list(const ProgramCommand& command) {
        Value words = Value::list();
        for (const std::string& word : command.words) words.items.push_back(Value::fromScalar(word, true));
        return words;
    }
};

class FolderNameType final : public ParameterType {
 public:
    const char* name() const override { return "string"; }

    void read(void* target, const Value& value, const std::string& what) const override {
        FolderName& folder = *static_cast<FolderName*>(target);
        folder = {value.asString(what), {}};
        if (folder.name.empty()) return;
        const fs::path path = besideFile(value, folder.name);
        folder.path = path.lexically_normal().string();
        if (!fs::is_directory(path)) throw UsageError(value.where, "{}: no folder '{}'", what, folder.path);
    }

    std::string text(const void* field) const override { return static_cast<const FolderName*>(field)->name; }
    /// The name, and the hash of the files in it: manifests tell which they were.
    Value value(const void* field) const override {
        const FolderName& folder = *static_cast<const FolderName*>(field);
        if (folder.name.empty()) return Value::fromScalar("", true);
        std::vector<fs::path> files;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder.path))
            if (entry.is_regular_file()) files.push_back(entry.path());
        std::ranges::sort(files);
        Hasher all;
        for (const fs::path& file : files) all.add(file.filename().string()).add(contentHash(file));
        return Value::fromScalar(folder.name + " (" + all.hex() + ")", true);
    }
};

}  // namespace

template <>
std::shared_ptr<const ParameterType> parameterType<TextFile>(TextFile, TextFile, bool, std::vector<TextFile>, bool) {
    return std::make_shared<TextFileType>();
}

template <>
std::shared_ptr<const ParameterType> parameterType<ProgramCommand>(ProgramCommand, ProgramCommand, bool,
                                                                   std::vector<ProgramCommand>, bool) {
    return std::make_shared<ProgramCommandType>();
}

template <>
std::shared_ptr<const ParameterType> parameterType<FolderName>(FolderName, FolderName, bool, std::vector<FolderName>,
                                                               bool) {
    return std::make_shared<FolderNameType>();
}

}  // namespace voxray

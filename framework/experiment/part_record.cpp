#include "experiment/part_record.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "experiment/reference_parts.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kEnding = ".json";

Json jsonOf(const PartRecord& record) {
    return {{"warnings", record.warnings},
            {"error", record.error},
            {"device", record.device},
            {"tracer", record.tracer},
            {"session", record.session}};
}

/// @throws nlohmann::json::exception.
PartRecord recordFrom(const Json& json) {
    const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
    return {json.at("warnings").get<std::vector<std::string>>(), text("error"), text("device"),
            text("tracer"), text("session")};
}

}  // namespace

PartRecords::PartRecords(const fs::path& results) : folder_(results / ReferenceParts::kFolder) {}

void PartRecords::store(const std::string& id, const PartRecord& record) const {
    const fs::path file = folder_ / (id + kEnding);
    if (!record.warnings.empty() || !record.error.empty()) {
        fs::create_directories(folder_);
        const std::string text = jsonOf(record).dump(1, ' ', false, Json::error_handler_t::replace);
        writeFileAtomically(file, text + "\n");
        return;
    }
    std::error_code code;
    fs::remove(file, code);
    if (code) throw Error("{}: {}", file.string(), code.message());
}

std::map<std::string, PartRecord> PartRecords::load() const {
    std::map<std::string, PartRecord> records;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder_, code)) {
        if (entry.path().extension() != kEnding || isTemporaryName(entry.path())) continue;
        try {
            records[entry.path().stem().string()] = recordFrom(Json::parse(readTextFile(entry.path())));
        } catch (const std::exception&) {  // Of a record there is nothing that a merge could not do without.
            continue;
        }
    }
    return records;
}

}  // namespace voxray

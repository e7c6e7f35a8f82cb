#include "app/image_request.h"

#include "app/session_requests.h"
#include "app/view_requests.h"
#include "config/yaml.h"

namespace voxray {
namespace {

constexpr const char* kShowImage = "image";

uint32_t wholeNumber(const Value& value, const std::string& key, int64_t low, int64_t high) {
    const int64_t number = value.asInteger(key);
    if (number < low || number > high) throw UsageError("request: {} is from {} to {}", key, low, high);
    return uint32_t(number);
}

std::vector<ShownState::Change> changesIn(const Value& list) {
    if (!list.isList()) throw UsageError("request: changes is no list");
    std::vector<ShownState::Change> changes;
    for (const Value& change : list.items) {
        if (!change.isMap() || change.members.size() != 2 || !change.find("value"))
            throw UsageError("request: a change is a map with path and value");
        changes.push_back({textOf(change, "path"), *change.find("value")});
    }
    return changes;
}

}  // namespace

ImageRequest parseImageRequest(const std::string& body) {
    const Value value = parseYaml(body, "request");
    if (!value.isMap()) throw UsageError("request: it is no map");
    ImageRequest request;
    std::string shown = kShowImage;
    const Value* parameters = nullptr;
    for (const auto& [key, entry] : value.members) {
        if (key == "page") {
            request.page = entry.asString(key);
        } else if (key == "side") {
            request.side = wholeNumber(entry, key, 0, InteractiveSession::kSides - 1);
        } else if (key == "variant") {
            request.variant = entry.asString(key);
        } else if (key == "config") {
            if (!entry.isMap()) throw UsageError("request: config is no map");
            request.config = entry;
        } else if (key == "shrink") {
            request.shrink = wholeNumber(entry, key, 1, 64);
        } else if (key == "show") {
            shown = entry.asString(key);
        } else if (key == "parameters") {
            parameters = &entry;
        } else if (key == "close") {
            request.closes = entry.asBool(key);
        } else if (key == "changes") {
            request.changes = changesIn(entry);
        } else {
            throw UsageError("request: unknown key '{}'", key);
        }
    }
    if (shown != kShowImage) request.view = viewChoice(shown, parameters, kMaxPictureValues);
    if (request.closes && request.side == 0) throw UsageError("request: side 0 is always open");
    return request;
}

}  // namespace voxray

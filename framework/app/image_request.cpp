#include "app/image_request.h"

#include <algorithm>

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

/// What a control of the page set: its user sees no request, and errors name paths.
Value unlocated(Value value) {
    locate(value, {});
    return value;
}

std::vector<ShownState::Change> changesIn(const Value& list) {
    if (!list.isList()) throw UsageError("request: changes is no list");
    std::vector<ShownState::Change> changes;
    for (const Value& change : list.items) {
        if (!change.isMap() || change.members.size() != 2 || !change.find("value"))
            throw UsageError("request: a change is a map with path and value");
        changes.push_back({textOf(change, "path"), unlocated(*change.find("value"))});
    }
    return changes;
}

Value mapIn(const std::string& body) {
    Value value = parseYaml(body, "request");
    if (!value.isMap()) throw UsageError("request: it is no map");
    return value;
}

/// Takes an entry that all requests have. @return whether it is one.
bool takeSender(ImageRequest& request, const std::string& key, const Value& entry) {
    if (key == "page")
        request.page = entry.asString(key);
    else if (key == "side")
        request.side = wholeNumber(entry, key, 0, InteractiveSession::kSides - 1);
    else
        return false;
    return true;
}

}  // namespace

ImageRequest parseImageRequest(const std::string& body) {
    const Value value = mapIn(body);
    ImageRequest request;
    std::string shown = kShowImage;
    std::optional<Value> parameters;
    for (const auto& [key, entry] : value.members) {
        if (takeSender(request, key, entry)) continue;
        if (key == "variant") {
            request.variant = entry.asString(key);
        } else if (key == "config") {
            if (!entry.isMap()) throw UsageError("request: config is no map");
            request.config = unlocated(entry);
        } else if (key == "shrink") {
            request.shrink = wholeNumber(entry, key, 1, 64);
        } else if (key == "show") {
            shown = entry.asString(key);
        } else if (key == "parameters") {
            parameters = unlocated(entry);
            parameters->where = entry.where;  // What is wrong with the map itself no control did
        } else if (key == "close") {
            request.closes = entry.asBool(key);
        } else if (key == "changes") {
            request.changes = changesIn(entry);
        } else {
            throw UsageError("request: unknown key '{}'", key);
        }
    }
    if (shown != kShowImage) request.view = viewChoice(shown, parameters ? &*parameters : nullptr, kMaxPictureValues);
    if (request.closes && request.side == 0) throw UsageError("request: side 0 is always open");
    return request;
}

ImageRequest parseReferenceRequest(const std::string& body) {
    const Value value = mapIn(body);
    ImageRequest request;
    request.asksReference = true;
    for (const auto& [key, entry] : value.members) {
        if (takeSender(request, key, entry)) continue;
        if (key == "show")
            request.show = entry.asString(key);
        else if (key == "known")
            request.known = entry.asString(key);
        else
            throw UsageError("request: unknown key '{}'", key);
    }
    const auto& known = {"", kShowReference, kShowError, kShowIndirectError};
    if (std::ranges::find(known, request.show) == std::end(known))
        throw UsageError("request: show is '{}', '{}' or '{}'", kShowReference, kShowError, kShowIndirectError);
    return request;
}

}  // namespace voxray

#include "experiment/json_text.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiment/results.h"

namespace voxray {
namespace {

using PlainJson = nlohmann::json;

/// Reads a document up to a text. Each handler tells whether to go on.
class TextSearch final : public PlainJson::json_sax_t {
 public:
    explicit TextSearch(const std::vector<std::string>& path) : path_(path) {}
    const std::string& found() const { return found_; }

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool string(string_t& text) override {
        if (keys_ != path_) return true;
        found_ = std::move(text);
        return false;
    }
    bool start_object(size_t) override { return enter(); }
    bool end_object() override { return leave(); }
    bool start_array(size_t) override { return enter(); }
    bool end_array() override { return leave(); }
    bool key(string_t& text) override {
        keys_.back() = std::move(text);
        return true;
    }
    bool parse_error(size_t, const std::string&, const PlainJson::exception&) override { return false; }

 private:
    bool enter() {
        keys_.emplace_back();
        return true;
    }
    bool leave() {
        keys_.pop_back();
        return true;
    }

    const std::vector<std::string>& path_;
    std::vector<std::string> keys_;  ///< Of all objects that it is in; "" for lists.
    std::string found_;
};

}  // namespace

std::string jsonTextAt(std::string_view json, const std::vector<std::string>& path) {
    TextSearch search(path);
    PlainJson::sax_parse(json, &search);
    return search.found();
}

nlohmann::ordered_json numberJson(double value) {
    using Json = nlohmann::ordered_json;
    return std::isfinite(value) ? Json(value) : Json(numberText(value));
}

nlohmann::ordered_json scoresJson(const Scores& scores, const std::string& suffix) {
    auto json = nlohmann::ordered_json::object();
    for (const auto& [column, value] : scores) json[column + suffix] = numberJson(value);
    return json;
}

}  // namespace voxray

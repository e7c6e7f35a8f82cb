#include "app/view_requests.h"

#include "app/text_values.h"
#include "base/field.h"
#include "experiment/view_files.h"

namespace voxray {

Value describe(const ViewInfo& info) {
    Value value = Value::map(), shape = Value::list();
    for (const uint64_t size : info.shape) shape.items.push_back(numberValue(size));
    value.set("name", quotedText(info.name));
    value.set("pass", quotedText(info.pass));
    value.set("kind", quotedText(enumName(info.kind)));
    value.set("type", quotedText(enumName(info.type)));
    value.set("shape", std::move(shape));
    value.set("channels", listOf(info.channels));
    value.set("quantity", quotedText(enumName(info.quantity)));
    return value;
}

Value listViews(ShownState& state) {
    Value views = Value::list();
    for (const ViewInfo& info : state.views()) views.items.push_back(describe(info));
    const std::vector<std::string> shows = state.voxelsToShow();
    if (shows.empty()) return views;
    Value voxels = Value::map();
    voxels.set("name", quotedText(kShowVoxels));
    voxels.set("pass", quotedText(kShowVoxels));
    voxels.set("kind", quotedText(enumName(ViewInfo::Kind::Voxels)));
    voxels.set("channels", listOf({"R", "G", "B"}));
    voxels.set("shows", listOf(shows));
    views.items.push_back(std::move(voxels));
    return views;
}

ViewChoice viewChoice(const std::string& name, const Value* parameters, uint64_t maxValues) {
    ViewChoice choice{name, Value::map(), maxValues};
    if (!parameters || parameters->isNull()) return choice;
    if (!parameters->isMap()) throw UsageError(parameters->where, "view: parameters is no map");
    if (name != kShowVoxels && !parameters->members.empty())
        throw UsageError(parameters->where, "view: '{}' has no parameters; {} has", name, kShowVoxels);
    choice.parameters = *parameters;
    return choice;
}

void describe(Value& answer, const ViewPicture& picture) {
    answer.set("legend", quotedText(picture.legend));
    if (!picture.range) return;
    Value range = Value::list();
    range.items = {numberValue(picture.range->first), numberValue(picture.range->second)};
    answer.set("range", std::move(range));
}

Value writeView(ShownState& state, const ViewChoice& choice, bool withPicture, const std::filesystem::path& folder) {
    const ViewArray view = state.view(choice);
    Value answer = describe(view);
    answer.set("file", quotedText(writeView(folder, view).string()));
    if (withPicture) {
        const ViewPicture picture = pictureOf(view, state.renderedImage());
        const std::filesystem::path file = folder / "view.png";
        writePng(file, picture.display);
        answer.set("picture", quotedText(file.string()));
        describe(answer, picture);
    }
    return answer;
}

}  // namespace voxray

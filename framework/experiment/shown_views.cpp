// Views of a shown state's last rendering.
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/shown_state.h"

namespace voxray {
namespace {

/// An entry of a graph that draws voxels. @throws UsageError for keys that are none of a view's.
Value voxelsEntry(const ViewChoice& choice) {
    Value entry = choice.parameters;
    for (const char* key : {"pass", "id"})
        if (const Value* value = entry.find(key))
            throw UsageError(value->where, "{}: unknown parameter '{}'", kShowVoxels, key);
    entry.set("pass", Value::fromScalar(kShowVoxels));
    return entry;
}

/// Appends the pass that draws voxels. @return its id, which no other pass has.
std::string appendVoxels(Graph& graph, const Registry& registry, const ViewChoice& choice) {
    Value entry = voxelsEntry(choice);
    std::string id = kShowVoxels;
    const std::vector<Graph::PassInfo> passes = graph.passes();
    while (std::ranges::count(passes, id, &Graph::PassInfo::id) > 0) id += " (view)";
    entry.set("id", Value::fromScalar(id, true));
    graph.append(registry, entry);
    return id;
}

ViewArray voxelsView(const Graph& graph, Session& resources, const ViewChoice& choice) {
    ViewInfo info;
    info.name = info.pass = kShowVoxels;
    info.kind = ViewInfo::Kind::Voxels;
    const Value* show = choice.parameters.find("show");
    const std::string what = show ? show->scalar : "";
    info.quantity = what == "irradiance" || what == "radiance" ? Quantity::Radiance : Quantity::Fraction;
    if (what == "irradiance") info.note = "magenta: the injection gives no value there";
    if (what == "lit_faces") info.note = "green: no lit face is seen, red: the most; magenta: no surfel faces that way";
    return viewOfImage(std::move(info), downloadFrame(graph, 0, resources).final, {"R", "G", "B"});
}

/// The pass that a view is of. @throws UsageError if it is none of the graph.
Graph::PassInfo passOf(const Graph& graph, const std::string& view) {
    const std::vector<Graph::PassInfo> passes = graph.passes();
    const auto found = std::ranges::find(passes, view.substr(0, view.find('.')), &Graph::PassInfo::id);
    if (found != passes.end()) return *found;
    std::vector<std::string> ids;
    for (const Graph::PassInfo& pass : passes) ids.push_back(pass.id);
    throw UsageError("no view '{}': it begins with the id of a pass that runs, one of {}", view, fmt::join(ids, ", "));
}

}  // namespace

void ShownState::runOnlyFor(Graph& graph, const ViewChoice& choice) const {
    graph.runOnlyFor(choice.name == kShowVoxels ? appendVoxels(graph, *study_.registry, choice)
                                                : passOf(graph, choice.name).id);
}

ViewArray ShownState::readShown(const Graph& graph, const Frame& frame, const glm::vec3& origin,
                                const ViewChoice& choice) const {
    if (choice.name == kShowVoxels) return voxelsView(graph, resources_, choice);
    return readView({graph, frame, origin, resources_.device(), resources_.stream()}, choice.name, choice.maxValues);
}

const ShownState::Rendered& ShownState::requireRendered() const {
    if (!rendered_) throw UsageError("nothing is rendered yet, or the last rendering failed");
    return *rendered_;
}

const ImageSettings& ShownState::renderedImage() const {
    return requireRendered().setup.image;
}

std::vector<ViewInfo> ShownState::views() const {
    requireRendered();
    return listViews(*graph_, resources_.device());
}

std::vector<std::string> ShownState::voxelsToShow() {
    requireRendered();
    const PassKind* kind = study_.registry->find(kShowVoxels);
    if (!kind) return {};
    std::vector<std::string> shows;
    for (const std::string& show : std::ranges::find(kind->parameters, "show", &ParameterDoc::name)->choices) {
        ViewChoice choice{kShowVoxels, Value::map(), 0};
        choice.parameters.set("show", Value::fromScalar(show));
        try {
            appendVoxels(*graph_, *study_.registry, choice);
        } catch (const UsageError&) {
            continue;  // No pass writes what it reads
        }
        graph_->dropLast();
        shows.push_back(show);
    }
    return shows;
}

ViewArray ShownState::view(const ViewChoice& choice) {
    const Rendered& rendered = requireRendered();
    SceneOnDevice& scene = resources_.scene(rendered.setup);
    Frame frame = rendered.frame;
    frame.scene = &scene.prepared.state;
    if (choice.name != kShowVoxels) {
        if (passOf(*graph_, choice.name).isSkipped)
            throw UsageError("no view '{}': its pass did not run for the view that was shown", choice.name);
        return readShown(*graph_, frame, scene.prepared.origin, choice);
    }
    graph_->keepAll();
    appendVoxels(*graph_, *study_.registry, choice);
    try {
        resources_.plan(*graph_, frame, 0);
        graph_->prepare(frame, resources_.device(), resources_.compiler(), resources_.stream());
        graph_->run(Phase::Frame, frame, resources_.device(), resources_.stream(), *scene.tracer, scene.gpu, 0, true);
        ViewArray view = voxelsView(*graph_, resources_, choice);
        graph_->dropLast();
        return view;
    } catch (...) {
        resources_.stream().discard();
        graph_->dropLast();
        throw;
    }
}

}  // namespace voxray

#include "experiment/session.h"

#include <algorithm>
#include <chrono>

#include "base/files.h"
#include "base/interrupt.h"
#include "config/camera_path.h"
#include "experiment/checks/cost.h"
#include "vulkan/size_error.h"

namespace voxray {

Session::Session(const DeviceOptions& device, const std::filesystem::path& sourceRoot,
                 std::vector<std::filesystem::path> sceneFolders)
    : device_(device),
      stream_(device_),
      cacheError_(whyNotWritable(cacheFolder())),
      compiler_(sourceRoot, cacheFolder() / "spirv"),
      loader_(std::move(sceneFolders)),
      cache_(cacheFolder() / "references") {
    if (!cacheError_.empty())
        warnings_.push_back(
            fmt::format("{}: shaders and references are not cached, which costs time; "
                        "point VOXRAY_CACHE to a folder that can be written",
                        cacheError_));
}

std::string Session::tracerName(const Setup& setup) const {
    const TracerKind kind = resolveTracer(setup.general.tracer, device_);
    return enumName(kind);
}

bool Session::moveCamera(const Setup& setup) {
    const std::string sceneKey = loader_.key(setup.scene), key = sceneKey + " " + tracerName(setup);
    auto found = std::ranges::find(scenes_, key, &SceneOnDevice::key);
    if (found == scenes_.end()) {
        if (setup.scene.camera) found = std::ranges::find(scenes_, cameralessKey(setup), &SceneOnDevice::cameraless);
        if (found == scenes_.end()) return false;
        SceneLoader::setCamera(found->prepared, setup.scene);
        found->key = key;
    }
    scenes_.splice(scenes_.begin(), scenes_, found);
    Frame ignored;
    if (found->isMoved) goToFrame(setup, ignored, 0);
    found->isMoved = false;
    loader_.setTaken(&found->prepared, sceneKey);
    return true;
}

std::string Session::cameralessKey(const Setup& setup) {
    SceneSettings settings = setup.scene;
    settings.camera.reset();
    settings.cameraName.clear();
    return loader_.key(settings) + " " + tracerName(setup);
}

void Session::keepScenes(size_t count) {
    keptScenes_ = count;
    while (scenes_.size() > keptScenes_) scenes_.pop_back();
}

SceneOnDevice& Session::scene(const Setup& setup) {
    if (moveCamera(setup)) return scenes_.front();
    const std::string sceneKey = loader_.key(setup.scene);
    // Old scenes are freed first: more than keptScenes_ may not fit
    loader_.setTaken(nullptr, {});
    while (scenes_.size() >= keptScenes_) scenes_.pop_back();
    try {
        loadScene(setup, sceneKey);
    } catch (const SizeError&) {
        if (scenes_.empty()) throw;
        scenes_.clear();
        loadScene(setup, sceneKey);
    }
    return scenes_.front();
}

void Session::loadScene(const Setup& setup, const std::string& sceneKey) {
    SceneOnDevice& scene = scenes_.emplace_front();  // The tracer keeps a pointer to the state
    try {
        scene.prepared = loader_.takeCached(setup.scene, sceneKey);
        scene.gpu = makeGpuScene(device_, stream_, scene.prepared.state);
        stream_.finish();
        const auto start = std::chrono::steady_clock::now();
        scene.tracer = makeRayTracer(setup.general.tracer, device_, compiler_, scene.prepared.state);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        scene.tracerBuildMs = taken.count();
    } catch (const SizeError& error) {
        const std::string advice = sceneSizeAdvice(setup.scene, scene.prepared.state);
        stream_.discard();
        scenes_.pop_front();
        throw SizeError(setup.scene.where, "scene: {}; {}", error.what(), advice);
    } catch (...) {
        stream_.discard();
        scenes_.pop_front();
        throw;
    }
    scene.key = sceneKey + " " + tracerName(setup);
    scene.cameraless = cameralessKey(setup);
    scene.version = ++sceneVersions_;
    loader_.setTaken(&scene.prepared, sceneKey);
}

void Session::goToFrame(const Setup& setup, Frame& frame, int fromCompared) {
    SceneOnDevice& scene = scenes_.front();
    scene.isMoved = true;
    scene.version = ++sceneVersions_;
    loader_.setTaken(nullptr, {});
    frame.changedRegions = SceneLoader::goToFrame(scene.prepared, setup.scene, fromCompared);
    ++frame.sceneVersion;
    frame.camera = scene.prepared.camera;
    updateGpuScene(stream_, scene.prepared.state, scene.gpu);
    scene.tracer->update(stream_);
    stream_.finish();
}

Frame Session::enterFrame(const Setup& setup, uint32_t number, uint64_t seed) {
    SceneOnDevice& onDevice = scene(setup);
    Frame frame = frameOf(setup, onDevice.prepared, seed);
    if (number > 0 && changesInTime(setup.scene)) {
        goToFrame(setup, frame, int(number));
        frame.changedRegions.reset();
    }
    if (frame.moveCamera) frame.moveCamera(frame.camera, int(number));
    return frame;
}

std::vector<PixelSelection> Session::selectPixels(const Study& study, const Setup& setup, uint32_t number) {
    const std::vector<MaskSettings>& masks = study.experiment.measure.masks;
    if (masks.empty()) return {};
    if (number == 0)
        if (const auto known = study.masks.find(maskKey(loader_.key(setup.scene), setup.image));
            known != study.masks.end())
            return known->second;
    const Frame frame = enterFrame(setup, number, setup.general.seed);
    return voxray::selectPixels(masks, *frame.scene, frame.camera, frame.width, frame.height);
}

std::vector<PassMemory> Session::plan(Graph& graph, const Frame& frame, uint64_t limitMb) {
    const uint64_t total = device_.memoryLimitBytes(), used = device_.memoryUsedBytes() - graph.reusedBytes();
    uint64_t limit = total > used ? total - used : 0;
    if (limitMb > 0) limit = std::min(limit, limitMb << 20);
    return graph.plan(frame, device_.info(), limit);
}

std::string Session::referenceHashOf(const Study& study, const Setup& setup, uint32_t number) {
    if (study.reference.isNull()) return {};
    const std::string first =
        referenceHash(loader_.key(setup.scene), study.reference, setup.image, referenceSeed(setup.general.seed));
    if (number == 0 || isStatic(setup.scene)) return first;

    // Motion has no influence on frame 0
    Hasher hasher;
    hasher.add(first).addPlain(number).addPlain(setup.scene.options.timeStep);
    hasher.addPlain(setup.scene.camera ? setup.scene.camera->move : glm::vec3(0.0f));
    if (setup.scene.camera)
        for (const CameraKey& key : setup.scene.camera->path) hasher.add(writeParams(key).text());
    for (const ConfigLight& light : setup.scene.lights) hasher.addPlain(light.move).addPlain(light.offAt);
    return hasher.hex();
}

const ReferenceImages& Session::reference(const Study& study, const Setup& setup,
                                          const std::function<void(double)>& progress) {
    const std::string hash = referenceHashOf(study, setup);
    if (reference_ && reference_->hash == hash) return *reference_;
    if (const auto failed = failedReferences_.find(hash); failed != failedReferences_.end())
        throw Error("{}", failed->second);
    reference_.reset();
    try {
        return reference_.emplace(frameReference(study, setup, 0, progress));
    } catch (const std::exception& error) {
        if (interruptRequested()) throw Interrupted();
        throw Error("{}", failedReferences_[hash] = std::string("reference: ") + error.what());
    }
}

bool Session::hasReference(const std::string& hash) const {
    return cache_.has(hash) || (parts_ && parts_->isWhole(hash));
}

std::optional<ReferenceImages> Session::storedReference(const std::string& hash, const Setup& setup) {
    const uint32_t width = setup.image.width, height = setup.image.height;
    if (auto cached = cache_.load(hash, width, height)) return cached;
    if (!parts_ || !parts_->isWhole(hash)) return {};
    ReferenceImages merged = imagesOf(parts_->load(hash, width, height));
    merged.hash = hash;
    storeReference(merged);
    return merged;
}

void Session::storeReference(const ReferenceImages& reference) {
    if (!cacheError_.empty()) return;
    try {
        cache_.store(reference);
    } catch (const Error& error) {
        cacheError_ = error.what();
        warnings_.push_back(fmt::format("{}: references are not cached, which costs time", cacheError_));
    }
}

ReferenceImages Session::frameReference(const Study& study, const Setup& setup, uint32_t number,
                                        const std::function<void(double)>& progress) {
    const std::string hash = referenceHashOf(study, setup, number);
    if (auto known = storedReference(hash, setup)) return std::move(*known);
    ReferenceImages rendered = imagesOf(renderPart(study, setup, number, {}, progress));
    rendered.hash = hash;
    storeReference(rendered);
    return rendered;
}

RenderedPart Session::referencePart(const Study& study, const Setup& setup, uint32_t number, SamplePart samples,
                                    const std::function<void(double)>& progress) {
    if (const auto cached = cache_.load(referenceHashOf(study, setup, number), setup.image.width, setup.image.height))
        return partOf(*cached);
    return renderPart(study, setup, number, samples, progress);
}

RenderedPart Session::renderPart(const Study& study, const Setup& setup, uint32_t number, SamplePart samples,
                                 const std::function<void(double)>& progress) {
    Frame frame = enterFrame(setup, number, referenceSeed(setup.general.seed));
    frame.samples = samples;
    SceneOnDevice& onDevice = scenes_.front();
    Graph graph = study.referenceGraph();
    plan(graph, frame, 0);
    graph.prepare(frame, device_, compiler_, stream_);
    return renderReference(graph, {frame, device_, stream_, *onDevice.tracer, onDevice.gpu, {}}, number, progress);
}

std::vector<std::string> Session::warnings() const {
    std::vector<std::string> all = loader_.warnings();
    all.insert(all.end(), warnings_.begin(), warnings_.end());
    return all;
}

bool isStatic(const SceneSettings& settings) {
    return !changesInTime(settings) && (!settings.camera || !cameraMoves(*settings.camera));
}

Frame frameOf(const Setup& setup, const PreparedScene& prepared, uint64_t seed) {
    Frame frame;
    frame.scene = &prepared.state;
    frame.camera = prepared.camera;
    if (setup.scene.camera && cameraMoves(*setup.scene.camera))
        frame.moveCamera = [settings = *setup.scene.camera, origin = prepared.origin](Camera& camera, int number) {
            if (settings.path.empty()) {
                camera.position += float(number) * settings.move;
                return;
            }
            camera = cameraOf(cameraOnPath(settings, number));
            camera.position -= origin;
        };
    frame.width = setup.image.width;
    frame.height = setup.image.height;
    frame.seed = seed;
    frame.exposureStops = setup.image.exposureStops;
    return frame;
}

}  // namespace voxray

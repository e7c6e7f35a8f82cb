#include "passes/view/denoise_oidn/open_image_denoise.h"

#include <dlfcn.h>

#include <memory>
#include <string>

#include "base/error.h"

namespace voxray {
namespace {

// Enumerators of the C API.
constexpr int kDeviceCpu = 1;
constexpr int kFloat3 = 3;
constexpr int kNoError = 0;

constexpr const char* kHowToGet =
    "get a release 2.x for Linux from https://www.openimagedenoise.org (Debian has no package), and put its folder 'lib' "
    "into LD_LIBRARY_PATH, or its file's path into 'library'";

}  // namespace

/// What is called of the C API; handles are opaque.
struct OpenImageDenoise::Api {
    struct DeviceHandle;
    struct FilterHandle;
    using OidnDevice = DeviceHandle*;
    using OidnFilter = FilterHandle*;
    struct Close {
        void operator()(void* library) const { dlclose(library); }
    };
    std::unique_ptr<void, Close> library;
    OidnDevice (*newDevice)(int type) = nullptr;
    void (*commitDevice)(OidnDevice) = nullptr;
    int (*getDeviceError)(OidnDevice, const char** message) = nullptr;
    void (*releaseDevice)(OidnDevice) = nullptr;
    OidnFilter (*newFilter)(OidnDevice, const char* type) = nullptr;
    void (*setSharedFilterImage)(OidnFilter, const char* name, void* data, int format, size_t width, size_t height,
                                 size_t byteOffset, size_t pixelBytes, size_t rowBytes) = nullptr;
    void (*setFilterBool)(OidnFilter, const char* name, bool value) = nullptr;
    void (*commitFilter)(OidnFilter) = nullptr;
    void (*executeFilter)(OidnFilter) = nullptr;
    void (*releaseFilter)(OidnFilter) = nullptr;

    // Made once, since the library builds its network for them.
    OidnDevice device = nullptr;
    OidnFilter filter = nullptr;

    explicit Api(const std::string& name) : library(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        if (!library) throw Error("denoise_oidn: Open Image Denoise can't be loaded: {}; {}", dlerror(), kHowToGet);
        find(newDevice, "oidnNewDevice", name);
        find(commitDevice, "oidnCommitDevice", name);
        find(getDeviceError, "oidnGetDeviceError", name);
        find(releaseDevice, "oidnReleaseDevice", name);
        find(newFilter, "oidnNewFilter", name);
        find(setSharedFilterImage, "oidnSetSharedFilterImage", name);
        find(setFilterBool, "oidnSetFilterBool", name);
        find(commitFilter, "oidnCommitFilter", name);
        find(executeFilter, "oidnExecuteFilter", name);
        find(releaseFilter, "oidnReleaseFilter", name);
    }

    ~Api() {
        if (filter) releaseFilter(filter);
        if (device) releaseDevice(device);
    }
    Api(const Api&) = delete;
    Api& operator=(const Api&) = delete;

    template <typename Function>
    void find(Function& function, const char* symbol, const std::string& name) {
        function = reinterpret_cast<Function>(dlsym(library.get(), symbol));
        if (!function) throw Error("denoise_oidn: '{}' has no {}, so it is not version 2; {}", name, symbol, kHowToGet);
    }

    /// @throws Error with the words of the device's first error since the last call; without a device, the thread's.
    void check() const {
        const char* message = nullptr;
        if (getDeviceError(device, &message) != kNoError)
            throw Error("denoise_oidn: Open Image Denoise: {}", message ? message : "an error without a message");
    }

    void makeFilter() {
        if (!device) {
            device = newDevice(kDeviceCpu);
            if (device) commitDevice(device);
        }
        check();
        filter = newFilter(device, "RT");
        check();
        setFilterBool(filter, "hdr", true);
        setFilterBool(filter, "cleanAux", true);  // The G-buffer has no noise
    }
};

OpenImageDenoise::OpenImageDenoise(const std::string& library) : api_(std::make_unique<Api>(library)) {}
OpenImageDenoise::~OpenImageDenoise() = default;

std::vector<float> OpenImageDenoise::denoise(const NoisyImage& image) {
    Api& api = *api_;
    if (!api.filter) api.makeFilter();
    std::vector<float> result(size_t(image.width) * image.height * 4, 1.0f);
    constexpr size_t kPixelBytes = NoisyImage::kFloats * sizeof(float);
    void* const input = const_cast<float*>(image.pixels.data());  // Inputs are not written
    size_t offset = 0;
    for (const char* name : {"color", "albedo", "normal"}) {
        api.setSharedFilterImage(api.filter, name, input, kFloat3, image.width, image.height, offset, kPixelBytes,
                                 kPixelBytes * image.width);
        offset += 3 * sizeof(float);
    }
    api.setSharedFilterImage(api.filter, "output", result.data(), kFloat3, image.width, image.height, 0,
                             4 * sizeof(float), 4 * sizeof(float) * image.width);
    api.commitFilter(api.filter);
    api.executeFilter(api.filter);
    api.check();
    return result;
}

}  // namespace voxray

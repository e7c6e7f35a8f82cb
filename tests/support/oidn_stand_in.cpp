// A stand-in for Open Image Denoise, for tests of denoise_oidn: the functions of the C API that it calls, a filter that
// adds ten times the albedo to the radiance, and errors where inputs are not what the library is promised.
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <string>

namespace {

struct Picture {
    char* data = nullptr;
    size_t width = 0, height = 0, pixelBytes = 0, rowBytes = 0;

    float* at(size_t x, size_t y) const { return reinterpret_cast<float*>(data + y * rowBytes + x * pixelBytes); }
};

std::string error;  // Of the only device.
std::map<std::string, Picture> images;
std::map<std::string, bool> flags;

void filter() {
    const Picture &color = images["color"], &albedo = images["albedo"], &normal = images["normal"],
                  &output = images["output"];
    if (!flags["hdr"]) error = "radiance without 'hdr'";
    if (color.width == 7) error = "seven columns are too many";
    for (size_t y = 0; y < color.height; ++y)
        for (size_t x = 0; x < color.width; ++x) {
            const float* n = normal.at(x, y);
            if (std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) > 1e-3f) error = "a normal is not of unit length";
            for (size_t c = 0; c < 3; ++c) output.at(x, y)[c] = color.at(x, y)[c] + 10 * albedo.at(x, y)[c];
        }
}

}  // namespace

extern "C" {

void* oidnNewDevice(int) {
    error.clear();
    images.clear();
    flags.clear();
    return &images;
}
void oidnCommitDevice(void*) {}
int oidnGetDeviceError(void*, const char** message) {
    *message = error.c_str();
    return error.empty() ? 0 : 2;
}
void oidnReleaseDevice(void*) {}
void* oidnNewFilter(void*, const char* type) {
    if (std::strcmp(type, "RT") != 0) error = "no such filter";
    return &flags;
}
void oidnSetSharedFilterImage(void*, const char* name, void* data, int format, size_t width, size_t height,
                              size_t offset, size_t pixelBytes, size_t rowBytes) {
    if (format != 3) error = "not three floats";
    images[name] = {static_cast<char*>(data) + offset, width, height, pixelBytes, rowBytes};
}
void oidnSetFilterBool(void*, const char* name, bool value) {
    flags[name] = value;
}
void oidnCommitFilter(void*) {}
void oidnExecuteFilter(void*) {
    filter();
}
void oidnReleaseFilter(void*) {}
}

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "app/commands.h"
#include "base/error.h"
#include "vulkan/device.h"

namespace voxray {

namespace {

/// The ray tracers that a device supports. Embree runs on the CPU with any device.
std::string tracersOf(const DeviceInfo& device) {
    std::string names;
    if (device.rayQuery) names += "ray_query, ";
    if (device.rayPipeline) names += "ray_pipeline, ";
    return names + "embree";
}

void printDevice(const DeviceInfo& device) {
    const auto yesNo = [](bool value) { return value ? "yes" : "no"; };
    fmt::print("{} ({})\n", device.name, device.isCpu ? "CPU" : "GPU");
    fmt::print("  driver            {}\n", device.driver);
    if (!device.missing.empty()) {
        fmt::print("  does not qualify  it lacks {}\n", fmt::join(device.missing, ", "));
        return;
    }
    fmt::print("  ray tracers       {}\n", tracersOf(device));
    fmt::print("  geometry shader   {}\n", yesNo(device.geometryShader));
    fmt::print("  64-bit atomics    {}\n", yesNo(device.shaderInt64Atomics));
    fmt::print("  conservative      {}\n",
               device.conservativeRaster ? "yes" : "no, lacks VK_EXT_conservative_rasterization");
    fmt::print("  samples a pixel   {}\n", fmt::join(listSampleCounts(device), ", "));
}

/// Prints all devices. @throws Error if none qualifies.
void printDevices() {
    const std::vector<DeviceInfo> devices = listDevices();
    for (const DeviceInfo& device : devices) printDevice(device);
    if (const std::string why = whyNoDevice(devices); !why.empty()) throw Error("{}", why);
}

}  // namespace

void addDevicesCommand(CLI::App& app, int&) {
    CLI::App* command =
        app.add_subcommand("devices", "List Vulkan devices, their features and the ray tracers that each can run.");
    command->callback([] { printDevices(); });
}

void addDoctorCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("doctor", "Tell what this machine has and lacks.");
    command->callback([] {
        fmt::print("Devices, best first:\n");
        printDevices();
        fmt::print("\nNothing is missing.\n");
    });
}

}  // namespace voxray

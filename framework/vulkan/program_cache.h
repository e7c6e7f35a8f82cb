#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "vulkan/program.h"

namespace voxray {

/// Programs of a device, shared by graphs: on a CPU a driver takes longer to create the pipelines of a graph
/// than many a graph takes to run. Internal to the vulkan layer.
class ProgramCache {
 public:
    /// The program of that key, made unless it is there. From any thread.
    /// @param key of everything that the program depends on, besides the device.
    std::shared_ptr<const Program> get(const std::string& key, const std::function<Program()>& make);

 private:
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const Program>> programs_;
};

}  // namespace voxray

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace httplib {
class Server;
}

namespace voxray {

class LoopbackGuard;

/// Serves the page of `voxray look` on the loopback, until it is destroyed.
class LookServer {
 public:
    struct Content {
        std::filesystem::path sourceRoot;  ///< Files of the page are read from it at each request.
        std::string start;                 ///< JSON that the page asks for first.
        /// Answers a request for an image, in a thread of the server; nullopt if a newer one took its place.
        /// @throws UsageError for a body that is no such request.
        std::function<std::optional<std::string>(const std::string& body)> image;
        /// The same for a request about the reference.
        std::function<std::optional<std::string>(const std::string& body)> reference;
    };
    /// @param port 0: one that is free. @throws Error if it is not free.
    LookServer(Content content, int port);
    ~LookServer();
    LookServer(const LookServer&) = delete;
    LookServer& operator=(const LookServer&) = delete;

    std::string address() const;

 private:
    Content content_;
    std::unique_ptr<httplib::Server> server_;
    std::unique_ptr<LoopbackGuard> guard_;
    std::thread thread_;
};

}  // namespace voxray

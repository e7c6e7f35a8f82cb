#include "app/look_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <string_view>

#include "app/loopback_guard.h"
#include "base/files.h"

namespace voxray {
namespace {

constexpr size_t kMaxRequestBytes = 1 << 20;
constexpr size_t kKeptRequests = 1 << 30;  // In one connection

struct PageFile {
    std::string_view name, path;
    const char* type;
};
constexpr std::array kPageFiles = {
    PageFile{"", "framework/look/look.html", "text/html; charset=utf-8"},
    PageFile{"look.js", "framework/look/look.js", "text/javascript; charset=utf-8"},
    PageFile{"camera.js", "framework/look/camera.js", "text/javascript; charset=utf-8"},
    PageFile{"passes.js", "framework/look/passes.js", "text/javascript; charset=utf-8"},
    PageFile{"reference.js", "framework/look/reference.js", "text/javascript; charset=utf-8"},
    PageFile{"keys.js", "framework/look/keys.js", "text/javascript; charset=utf-8"},
    PageFile{"path.js", "framework/look/path.js", "text/javascript; charset=utf-8"},
    PageFile{"split.js", "framework/look/split.js", "text/javascript; charset=utf-8"},
    PageFile{"side.js", "framework/look/side.js", "text/javascript; charset=utf-8"},
    PageFile{"times.js", "framework/look/times.js", "text/javascript; charset=utf-8"},
    PageFile{"views.js", "framework/look/views.js", "text/javascript; charset=utf-8"},
    PageFile{"look.css", "framework/look/look.css", "text/css; charset=utf-8"},
    PageFile{"style.css", "framework/report/style.css", "text/css; charset=utf-8"}};

void refuse(httplib::Response& response, int status, const std::string& why) {
    response.status = status;
    response.set_content(why + "\n", "text/plain; charset=utf-8");
}

}  // namespace

LookServer::LookServer(Content content, int port)
    : content_(std::move(content)), server_(std::make_unique<httplib::Server>()) {
    using httplib::Request, httplib::Response;
    // Its own options would let another program share the port
    server_->set_socket_options([](auto socket) {
        const int yes = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_->set_tcp_nodelay(true);
    server_->set_payload_max_length(kMaxRequestBytes);
    server_->set_keep_alive_max_count(kKeptRequests);
    server_->set_default_headers({{"Cache-Control", "no-store"},
                                  {"Content-Security-Policy",
                                   "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                                   "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
                                  {"Cross-Origin-Resource-Policy", "same-origin"},
                                  {"Referrer-Policy", "no-referrer"},
                                  {"X-Content-Type-Options", "nosniff"}});
    server_->set_pre_routing_handler([this](const Request& request, Response& response) {
        const std::string why =
            guard_->refusal(request.get_header_value("Host"), request.get_header_value("Origin"), request.path);
        if (why.empty()) return httplib::Server::HandlerResponse::Unhandled;
        refuse(response, 403, why);
        return httplib::Server::HandlerResponse::Handled;
    });
    server_->Get(".*", [this](const Request& request, Response& response) {
        const std::string name = guard_->nameIn(request.path).value_or("");
        if (name == "start.json") return response.set_content(content_.start, "application/json");
        for (const PageFile& file : kPageFiles)
            if (name == file.name)
                return response.set_content(readTextFile(content_.sourceRoot / file.path), file.type);
        refuse(response, 404, "nothing has this name");
    });
    server_->Post(".*", [this](const Request& request, Response& response) {
        const std::string name = guard_->nameIn(request.path).value_or("");
        if (name != "image" && name != "reference") return refuse(response, 404, "nothing has this name");
        try {
            const auto& answer = name == "image" ? content_.image : content_.reference;
            if (const std::optional<std::string> body = answer(request.body))
                response.set_content(*body, "application/octet-stream");
            else
                response.status = 204;  // Another request came first
        } catch (const std::exception& error) {
            refuse(response, 400, error.what());
        }
    });
    server_->set_error_handler([](const Request& request, Response& response) {
        if (!response.body.empty()) return;
        refuse(response, response.status,
               response.status == 404   ? fmt::format("the page has no answer to {}", request.method)
               : response.status == 413 ? fmt::format("a request has at most {} bytes", kMaxRequestBytes)
               : response.status == 414 ? "the address is too long"
                                        : "this is no HTTP request that the page makes");
    });

    const int bound = port == 0                                  ? server_->bind_to_any_port("127.0.0.1")
                      : server_->bind_to_port("127.0.0.1", port) ? port
                                                                 : -1;
    if (bound < 0) throw Error("port {} of the loopback is not free", port);
    guard_ = std::make_unique<LoopbackGuard>(bound);
    thread_ = std::thread([this] { server_->listen_after_bind(); });
    while (!server_->is_running()) std::this_thread::yield();  // Before, stop() has no effect
}

LookServer::~LookServer() {
    server_->stop();
    thread_.join();
}

std::string LookServer::address() const {
    return guard_->address();
}

}  // namespace voxray

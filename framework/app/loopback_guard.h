#pragma once

#include <fmt/format.h>
#include <sys/random.h>

#include <optional>
#include <string>

#include "base/error.h"

namespace voxray {

/// Tells requests of a page that this program serves on the loopback from those of other programs and other sites,
/// which a browser may send there, too.
class LoopbackGuard {
 public:
    /// @param port of the server; draws a token. @throws Error if the system has no random numbers.
    explicit LoopbackGuard(int port) : port_(port) {
        uint64_t words[2];
        if (::getrandom(words, sizeof words, 0) != sizeof words) throw Error("no random numbers for the token");
        token_ = fmt::format("{:016x}{:016x}", words[0], words[1]);
    }

    std::string address() const { return fmt::format("http://127.0.0.1:{}/{}/", port_, token_); }

    /// Why a request is refused; "" if it is not. A site whose name was made to point to the loopback has another
    /// Host, one that sends a request across sites another Origin, and neither knows the token.
    std::string refusal(const std::string& host, const std::string& origin, const std::string& path) const {
        if (host != fmt::format("127.0.0.1:{}", port_) && host != fmt::format("localhost:{}", port_))
            return "foreign Host: the address is that which voxray look printed";
        if (!origin.empty() && origin != "http://" + host) return "foreign Origin: the page must be voxray look's own";
        if (!nameIn(path)) return "no token: the address is that which voxray look printed";
        return {};
    }

    /// What follows the token in a path; nullopt without the token.
    std::optional<std::string> nameIn(const std::string& path) const {
        const std::string start = "/" + token_ + "/";
        if (!path.starts_with(start)) return {};
        return path.substr(start.size());
    }

 private:
    int port_;
    std::string token_;
};

}  // namespace voxray

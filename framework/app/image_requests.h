#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "experiment/interactive_session.h"

namespace voxray {

/// What a page asks to see.
struct ImageRequest {
    std::string page;     ///< Tells pages apart.
    std::string variant;  ///< Id; empty: the values as they are.
    std::vector<InteractiveSession::Change> changes;
    /// 1: the changes are kept, and the whole image is rendered. Above: InteractiveSession::draft().
    uint32_t shrink = 1;
};

/// Hands requests of a server's threads to the one thread that renders. Of each page the newest one counts: an older
/// one that waits is dropped, and a whole image of that page in the making is cancelled.
class ImageRequests {
 public:
    /// Waits for the answer. @return nullopt if a newer request took its place, or after close().
    std::optional<std::string> ask(ImageRequest request);

    /// Answers a request, if one arrives in time. @param answer may throw Interrupted.
    void answerNext(std::chrono::milliseconds patience, const std::function<std::string(const ImageRequest&)>& answer);
    void close();

 private:
    struct Asked {
        ImageRequest request;
        std::promise<std::optional<std::string>> answer;
    };

    std::mutex mutex_;
    std::condition_variable arrived_;
    std::list<Asked> waiting_;            ///< At most one of each page.
    std::optional<std::string> wholeOf_;  ///< The page whose whole image is in the making.
    bool isClosed_ = false;
};

}  // namespace voxray

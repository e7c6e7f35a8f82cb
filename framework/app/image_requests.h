#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <optional>
#include <string>

#include "app/image_request.h"

namespace voxray {

/// Hands requests of a server's threads to the one thread that renders. Of each side of a page the newest one counts:
/// an older one that waits is dropped, and a whole image of that side in the making is cancelled. Drafts come first:
/// one for the page's other side puts a whole image off, which is begun anew after it. Requests for a reference come
/// last; one that is being answered is dropped for an image.
class ImageRequests {
 public:
    /// Waits for the answer. @return nullopt if a newer request took its place, or after close().
    /// @throws what the answer threw.
    std::optional<std::string> ask(ImageRequest request);

    /// Answers a request, if one arrives in time. @param answer may throw Interrupted. @return whether one arrived.
    bool answerNext(std::chrono::milliseconds patience, const std::function<std::string(const ImageRequest&)>& answer);
    /// Does work in the thread that renders while nothing waits; a request for an image cancels it.
    /// @param task may throw Interrupted.
    void work(const std::function<void()>& task);
    void close();

 private:
    struct Asked {
        ImageRequest request;
        std::promise<std::optional<std::string>> answer;
    };

    std::mutex mutex_;
    std::condition_variable arrived_;
    std::list<Asked> waiting_;             ///< At most one of each side and kind of a page.
    const ImageRequest* whole_ = nullptr;  ///< The one whose whole image is in the making.
    bool isReplaced_ = false;              ///< Whether a newer one took its place.
    bool yields_ = false;                  ///< Whether what is being done is cancelled for any image.
    bool isClosed_ = false;
};

}  // namespace voxray

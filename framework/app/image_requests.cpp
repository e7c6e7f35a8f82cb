#include "app/image_requests.h"

#include <algorithm>

#include "base/interrupt.h"

namespace voxray {

std::optional<std::string> ImageRequests::ask(ImageRequest request) {
    std::future<std::optional<std::string>> answer;
    {
        const std::lock_guard lock(mutex_);
        if (isClosed_) return {};
        const auto older =
            std::ranges::find_if(waiting_, [&](const Asked& asked) { return asked.request.page == request.page; });
        if (older != waiting_.end()) {
            older->answer.set_value(std::nullopt);
            waiting_.erase(older);
        }
        if (wholeOf_ == request.page) requestCancel();
        answer = waiting_.emplace_back(Asked{std::move(request), {}}).answer.get_future();
    }
    arrived_.notify_one();
    return answer.get();
}

void ImageRequests::answerNext(std::chrono::milliseconds patience,
                               const std::function<std::string(const ImageRequest&)>& answer) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, patience, [&] { return !waiting_.empty(); })) return;
    Asked asked = std::move(waiting_.front());
    waiting_.pop_front();
    if (asked.request.shrink == 1) wholeOf_ = asked.request.page;
    lock.unlock();
    std::optional<std::string> body;
    try {
        body = answer(asked.request);
    } catch (const Interrupted&) {
    }
    lock.lock();
    wholeOf_.reset();
    clearCancel();
    lock.unlock();
    asked.answer.set_value(std::move(body));
}

void ImageRequests::close() {
    const std::lock_guard lock(mutex_);
    isClosed_ = true;
    for (Asked& asked : waiting_) asked.answer.set_value(std::nullopt);
    waiting_.clear();
}

}  // namespace voxray

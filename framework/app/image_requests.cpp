#include "app/image_requests.h"

#include <algorithm>
#include <exception>

#include "base/interrupt.h"

namespace voxray {
namespace {

bool isOfSameSide(const ImageRequest& a, const ImageRequest& b) {
    return a.page == b.page && a.side == b.side && a.asksReference == b.asksReference;
}

}  // namespace

std::optional<std::string> ImageRequests::ask(ImageRequest request) {
    std::future<std::optional<std::string>> answer;
    {
        const std::lock_guard lock(mutex_);
        if (isClosed_) return {};
        const auto older =
            std::ranges::find_if(waiting_, [&](const Asked& asked) { return isOfSameSide(asked.request, request); });
        if (older != waiting_.end()) {
            older->answer.set_value(std::nullopt);
            waiting_.erase(older);
        }
        if (whole_ && isOfSameSide(*whole_, request)) isReplaced_ = true;
        if (yields_ && !request.asksReference) requestCancel();
        if (isReplaced_ || (whole_ && whole_->page == request.page && request.isDraft())) requestCancel();
        answer = waiting_.emplace_back(Asked{std::move(request), {}}).answer.get_future();
    }
    arrived_.notify_one();
    return answer.get();
}

bool ImageRequests::answerNext(std::chrono::milliseconds patience,
                               const std::function<std::string(const ImageRequest&)>& answer) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, patience, [&] { return !waiting_.empty(); })) return false;
    const auto rank = [](const Asked& asked) {
        return asked.request.isDraft() ? 0 : asked.request.asksReference ? 2 : 1;
    };
    const auto next = std::ranges::min_element(waiting_, {}, rank);
    Asked asked = std::move(*next);
    waiting_.erase(next);
    yields_ = asked.request.asksReference;
    if (!asked.request.isDraft() && !yields_) whole_ = &asked.request;
    lock.unlock();
    std::optional<std::string> body;
    std::exception_ptr error;
    try {
        body = answer(asked.request);
    } catch (const Interrupted&) {
    } catch (...) {
        error = std::current_exception();
    }
    lock.lock();
    const bool isPutOff = !body && !error && whole_ && !isReplaced_ && !isClosed_;
    whole_ = nullptr;
    isReplaced_ = yields_ = false;
    clearCancel();
    if (isPutOff) {
        waiting_.push_back(std::move(asked));
        return true;
    }
    lock.unlock();
    if (error)
        asked.answer.set_exception(error);
    else
        asked.answer.set_value(std::move(body));
    return true;
}

void ImageRequests::work(const std::function<void()>& task) {
    {
        const std::lock_guard lock(mutex_);
        if (!waiting_.empty()) return;
        yields_ = true;
    }
    try {
        task();
    } catch (const Interrupted&) {
    }
    const std::lock_guard lock(mutex_);
    yields_ = false;
    clearCancel();
}

void ImageRequests::close() {
    const std::lock_guard lock(mutex_);
    isClosed_ = true;
    for (Asked& asked : waiting_) asked.answer.set_value(std::nullopt);
    waiting_.clear();
}

}  // namespace voxray

#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace voxray {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::string durationText(double seconds) {
    const long total = long(seconds + 0.5);
    if (total < 60) return fmt::format("{} s", total);
    if (total < 3600) return fmt::format("{} min {} s", total / 60, total % 60);
    return fmt::format("{} h {} min", total / 3600, total % 3600 / 60);
}

Progress::Progress(size_t steps, bool quiet)
    : steps_(std::max<size_t>(steps, 1)), quiet_(quiet), bar_(!quiet && isatty(STDERR_FILENO)) {}

Progress::~Progress() {
    clear();
}

void Progress::begin(const std::string& step) {
    step_ = step;
    stepStart_ = Clock::now();
    draw(0);
}

void Progress::update(double fraction) {
    if (bar_ && secondsSince(lastDrawn_) > 0.1) draw(fraction);
}

void Progress::end(const std::string& line, bool counted) {
    ++done_;
    if (counted) {
        ++counted_;
        countedSeconds_ += secondsSince(stepStart_);
    }
    clear();
    if (quiet_ || line.empty()) return;
    fmt::print("[{}/{}] {}\n", done_, steps_, line);
    std::fflush(stdout);
}

void Progress::warn(const std::string& line) {
    clear();
    fmt::print(stderr, "voxray: warning: {}\n", line);
}

void Progress::note(const std::string& line) {
    if (quiet_) return;
    clear();
    fmt::print("Note: {}\n", line);
}

void Progress::draw(double fraction) {
    if (!bar_) return;
    lastDrawn_ = Clock::now();

    // Time left: steps to come last as long as the mean of those done; this one by its own pace
    const double elapsed = secondsSince(stepStart_);
    std::string left;
    if (counted_ > 0 || fraction > 0.05) {
        const double perStep = counted_ > 0 ? countedSeconds_ / double(counted_) : elapsed / fraction;
        const double current = fraction > 0.05 ? elapsed / fraction - elapsed : std::max(0.0, perStep - elapsed);
        const size_t later = steps_ > done_ + 1 ? steps_ - done_ - 1 : 0;
        left = ", " + durationText(current + perStep * double(later)) + " left";
    }
    constexpr int kWidth = 24;
    const double whole = std::clamp((double(done_) + fraction) / double(steps_), 0.0, 1.0);
    const int filled = int(whole * kWidth);
    fmt::print(stderr, "\r\x1b[K[{}{}] {}/{} {}{}", std::string(size_t(filled), '#'),
               std::string(size_t(kWidth - filled), '.'), std::min(done_ + 1, steps_), steps_, step_, left);
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::clear() {
    if (!drawn_) return;
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
    drawn_ = false;
}

}  // namespace voxray

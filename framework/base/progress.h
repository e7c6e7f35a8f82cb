#pragma once

#include <chrono>
#include <string>

namespace voxray {

/// One line on stderr with a bar and the time left, where stderr is a terminal and the run isn't quiet; and a
/// plain line on stdout for each finished step, unless quiet.
class Progress {
 public:
    /// @param steps how many equal steps the whole run has.
    Progress(size_t steps, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Begins a step, e.g. "resolution 64".
    void begin(const std::string& step);
    /// How much of the step is done, in [0, 1]. Redraws at most ten times a second.
    void update(double fraction);
    /// Ends the step; `line` goes to stdout. Steps that took no time (`counted` false) don't enter the
    /// estimate of the time left.
    void end(const std::string& line, bool counted = true);
    /// A line that is shown even on a quiet run, on stderr.
    void warn(const std::string& line);
    /// A line on stdout, unless quiet, that asks for nothing.
    void note(const std::string& line);

 private:
    using Clock = std::chrono::steady_clock;
    void draw(double fraction);
    void clear();

    size_t steps_;
    bool quiet_;
    bool bar_;
    size_t done_ = 0;
    size_t counted_ = 0;
    double countedSeconds_ = 0;
    std::string step_;
    Clock::time_point stepStart_, lastDrawn_;
    bool drawn_ = false;
};

/// "48 s", "3 min 20 s", "1 h 5 min".
std::string durationText(double seconds);

}  // namespace voxray

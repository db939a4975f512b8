// Progress of a long measurement on stderr: a bar with the time that remains, and the wish to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>

namespace farlight::client {

/// Somebody asked to stop (SIGINT, SIGTERM).
struct Interrupted : std::runtime_error {
    Interrupted() : runtime_error("interrupted") { }
};

class Progress {
public:
    /// `bar`: stderr is a terminal; else a line is written for each phase and every tenth of the
    /// work.
    explicit Progress(bool bar) : bar_(bar) { }
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Work to come, in units of one traced sample a pixel.
    void plan(double units) { planned_ += units; }
    /// Planned, but found done already.
    void drop(double units) { planned_ -= units; }
    void phase(const std::string& name);
    /// Throws Interrupted when stop was wished for.
    void done(double units);

    /// Takes note of a wish to stop; for signal handlers.
    static void wish_to_stop() { stop_flag() = true; }
    static bool stop_wished() { return stop_flag(); }

private:
    static std::atomic<bool>& stop_flag();
    void show();

    using Clock = std::chrono::steady_clock;
    bool bar_;
    std::string phase_;
    double planned_ = 0;
    double done_ = 0;
    int tenths_shown_ = 0;
    Clock::time_point begun_ = Clock::now();
    Clock::time_point shown_;
};

/// "1 min 20 s"
std::string duration_text(double seconds);

}  // namespace farlight::client

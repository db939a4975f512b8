// The bar.
#include "client/accuracy/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace farlight::client {
namespace {

constexpr int kBarCharacters = 30;
constexpr std::chrono::milliseconds kShowEvery{200};

}  // namespace

std::string duration_text(double seconds)
{
    const long whole = std::lround(std::max(0.0, seconds));
    if (whole < 60)
        return std::to_string(whole) + " s";
    if (whole < 3600)
        return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

std::atomic<bool>& Progress::stop_flag()
{
    static std::atomic<bool> flag = false;
    return flag;
}

Progress::~Progress()
{
    if (bar_ && !phase_.empty())
        std::fputc('\n', stderr);
}

void Progress::phase(const std::string& name)
{
    phase_ = name;
    if (!bar_)
        std::fprintf(stderr, "%s\n", name.c_str());
    shown_ = {};
    show();
}

void Progress::done(double units)
{
    done_ += units;
    show();
    if (stop_wished())
        throw Interrupted();
}

void Progress::show()
{
    const auto now = Clock::now();
    const double share = planned_ > 0 ? std::clamp(done_ / planned_, 0.0, 1.0) : 0;
    const double elapsed = std::chrono::duration<double>(now - begun_).count();
    const std::string rest =
        share > 0.01 ? duration_text(elapsed * (1 - share) / share) + " left" : "";
    if (bar_) {
        if (now - shown_ < kShowEvery)
            return;
        shown_ = now;
        const int filled = static_cast<int>(share * kBarCharacters);
        std::fprintf(stderr, "\r[%s%s] %3.0f %%  %-14s %-46.46s", std::string(filled, '#').c_str(),
            std::string(kBarCharacters - filled, '.').c_str(), 100 * share, rest.c_str(),
            phase_.c_str());
        std::fflush(stderr);
    } else if (static_cast<int>(10 * share) > tenths_shown_) {
        tenths_shown_ = static_cast<int>(10 * share);
        std::fprintf(stderr, "%.0f %%  %s\n", 100 * share, rest.c_str());
    }
}

}  // namespace farlight::client

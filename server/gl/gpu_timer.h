// GpuTimer: how long each pass of a frame took.
//
// Hardware: a pair of GL_TIMESTAMP queries a pass, read when the frame's pixels have arrived.
// llvmpipe runs a dispatch inside the call and its timer queries read 0 around compute, so there
// the host clock around glFinish is the truth.
#pragma once

#include <chrono>
#include <epoxy/gl.h>
#include <string>
#include <vector>

namespace farlight {

struct TimedPass {
    std::string name;
    double milliseconds = 0;
};

class GpuTimer {
public:
    /// `host_clock`: for software devices.
    explicit GpuTimer(bool host_clock) : host_clock_(host_clock) { }
    ~GpuTimer();
    GpuTimer(const GpuTimer&) = delete;
    GpuTimer& operator=(const GpuTimer&) = delete;

    void begin_frame();
    void begin(const std::string& name);
    void end();
    void end_frame();
    /// Times of the last frame, in order. Waits for the queries: call it when the frame is known to
    /// be done.
    std::vector<TimedPass> collect();
    /// From the first pass's begin() to end_frame() [ms], likewise; 0 of a frame without passes.
    double whole_frame();

private:
    GLuint next_query();

    bool host_clock_;
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point frame_started_;
    double frame_ms_ = 0;  ///< By the host clock.
    std::vector<TimedPass> passes_;
    std::vector<GLuint> queries_;  ///< Two a pass, before and after, and one after them all.
    std::size_t used_queries_ = 0;
};

}  // namespace farlight

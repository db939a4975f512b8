// GlWorker: a thread with a context of its own that shares objects with another, for work that must
// not hold up frames.
#pragma once

#include "server/gl/context.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace farlight {

/// A program that a job has used may be deleted elsewhere while the worker is idle or gone, not
/// while it is busy: Mesa 22.3 lets go of it at the worker's next flush, takes the bound program
/// away with it, and does not notice; the next dispatch of the same program crashes (llvmpipe).
class GlWorker {
public:
    /// `main` must outlive the worker. Throws DeviceError.
    explicit GlWorker(const Context& main);
    /// Waits for the job being done; one that waits is dropped.
    ~GlWorker();
    GlWorker(const GlWorker&) = delete;
    GlWorker& operator=(const GlWorker&) = delete;

    /// Does `job` as soon as the present one is done; takes the place of one that waits. What a job
    /// throws is logged.
    void request(std::function<void()> job);
    /// Waits until there is nothing to do.
    void wait();
    /// Whether there is nothing to do, until the next request().
    bool idle();

private:
    void run();

    std::unique_ptr<Context> context_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> next_;
    bool busy_ = false;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace farlight

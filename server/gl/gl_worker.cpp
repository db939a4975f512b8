// One slot, newest wins.
#include "server/gl/gl_worker.h"

#include "server/gl/program.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

namespace farlight {

GlWorker::GlWorker(const Context& main) : context_(main.shared()), thread_([this] { run(); }) { }

GlWorker::~GlWorker()
{
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void GlWorker::request(std::function<void()> job)
{
    {
        const std::lock_guard lock(mutex_);
        next_ = std::move(job);
    }
    changed_.notify_all();
}

void GlWorker::wait()
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || (!next_ && !busy_); });
}

bool GlWorker::idle()
{
    const std::lock_guard lock(mutex_);
    return !next_ && !busy_;
}

void GlWorker::run()
{
    // Frames go first: on Linux a priority belongs to the thread.
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
    try {
        context_->make_current();
        // Used between jobs, when the programs of jobs are deleted.
        const Program resting(
            {"rest", "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n", {}});
        for (;;) {
            std::function<void()> job;
            {
                std::unique_lock lock(mutex_);
                busy_ = false;
                changed_.notify_all();
                changed_.wait(lock, [this] { return stopping_ || next_; });
                if (stopping_)
                    break;
                job = std::exchange(next_, nullptr);
                busy_ = true;
            }
            glFinish();  // lets go of what has been deleted
            try {
                job();
            } catch (const std::exception& problem) {
                spdlog::error("in the background: {}", problem.what());
            }
            glUseProgram(resting.id());
            glDispatchCompute(1, 1, 1);
            glFinish();
        }
    } catch (const std::exception& problem) {
        spdlog::error("no work in the background: {}", problem.what());
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        changed_.notify_all();
    }
    context_.reset();  // where it was current
}

}  // namespace farlight

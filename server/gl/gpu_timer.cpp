// Timestamp queries on hardware, the host clock on llvmpipe.
#include "server/gl/gpu_timer.h"

namespace farlight {

GpuTimer::~GpuTimer()
{
    glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

void GpuTimer::begin_frame()
{
    passes_.clear();
    used_queries_ = 0;
    frame_ms_ = 0;
}

void GpuTimer::end_frame()
{
    if (passes_.empty())
        return;
    if (host_clock_) {
        const std::chrono::duration<double, std::milli> spent =
            std::chrono::steady_clock::now() - frame_started_;
        frame_ms_ = spent.count();
    } else {
        glQueryCounter(next_query(), GL_TIMESTAMP);
    }
}

GLuint GpuTimer::next_query()
{
    if (used_queries_ == queries_.size()) {
        queries_.push_back(0);
        glCreateQueries(GL_TIMESTAMP, 1, &queries_.back());
    }
    return queries_[used_queries_++];
}

void GpuTimer::begin(const std::string& name)
{
    passes_.push_back({name, 0});
    if (host_clock_) {
        glFinish();
        started_ = std::chrono::steady_clock::now();
        if (passes_.size() == 1)
            frame_started_ = started_;
    } else {
        glQueryCounter(next_query(), GL_TIMESTAMP);
    }
}

void GpuTimer::end()
{
    if (host_clock_) {
        glFinish();
        const std::chrono::duration<double, std::milli> spent =
            std::chrono::steady_clock::now() - started_;
        passes_.back().milliseconds = spent.count();
    } else {
        glQueryCounter(next_query(), GL_TIMESTAMP);
    }
}

std::vector<TimedPass> GpuTimer::collect()
{
    for (std::size_t i = 0; !host_clock_ && i < passes_.size(); ++i) {
        GLuint64 before = 0;
        GLuint64 after = 0;
        glGetQueryObjectui64v(queries_[2 * i], GL_QUERY_RESULT, &before);
        glGetQueryObjectui64v(queries_[2 * i + 1], GL_QUERY_RESULT, &after);
        passes_[i].milliseconds = static_cast<double>(after - before) * 1e-6;
    }
    return passes_;
}

double GpuTimer::whole_frame()
{
    if (host_clock_ || passes_.empty())
        return frame_ms_;
    GLuint64 before = 0;
    GLuint64 after = 0;
    glGetQueryObjectui64v(queries_.front(), GL_QUERY_RESULT, &before);
    glGetQueryObjectui64v(queries_[2 * passes_.size()], GL_QUERY_RESULT, &after);
    return static_cast<double>(after - before) * 1e-6;
}

}  // namespace farlight

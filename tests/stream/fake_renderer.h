// FakeRenderer: a RenderService that draws deterministic pictures on a thread of its own, without
// OpenGL.
#pragma once

#include "server/stream/render_service.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace farlight {

/// The picture for the n-th frame of a view since its history began: depends on camera and n only.
Image fake_picture(const RenderRequest& request, std::uint32_t frame_index);

class FakeRenderer : public RenderService {
public:
    explicit FakeRenderer(std::chrono::milliseconds draw_time = std::chrono::milliseconds(0));
    ~FakeRenderer() override;

    std::shared_ptr<const RendererDescription> description() const override;
    /// Takes over `name`; refuses what has a `bad`.
    void edit(const nlohmann::json& merge_patch, bool reset) override;
    void attach(std::shared_ptr<FrameSource> source) override;
    void detach(const std::shared_ptr<FrameSource>& source) override;
    void wake() override;
    std::string failure() const override;
    std::uint64_t frames_rendered() const override { return frames_rendered_; }
    BadValueTotals bad_values() const override
    {
        const std::lock_guard lock(state_mutex_);
        return bad_values_;
    }

    void fail(const std::string& why);
    /// Every frame from now on carries this error.
    void fail_frames(const std::string& why);
    std::size_t sources() const;

    void meet(const BadValues& more)
    {
        const std::lock_guard lock(state_mutex_);
        bad_values_.add(more);
    }

private:
    struct View {
        std::shared_ptr<FrameSource> source;
        std::optional<RenderRequest> previous;
        std::uint32_t frames = 0;
        std::uint32_t samples = 0;
    };

    void run();
    /// Draws for each view that wants it. False: none did. Called with mutex_ held.
    bool draw_round();
    void take_in_attached();
    RenderedFrame draw(View& view, const RenderRequest& request) const;

    const std::chrono::milliseconds draw_time_;
    RendererDescription description_;
    mutable std::mutex mutex_;  ///< Held while drawing: detach() waits for it, as it may.
    std::condition_variable woken_;
    std::vector<View> views_;
    bool stop_ = false;
    mutable std::mutex state_mutex_;  ///< Held for moments only.
    std::vector<std::shared_ptr<FrameSource>> attached_;  ///< Not yet in views_.
    std::string failure_;
    std::string frame_error_;
    BadValueTotals bad_values_;
    std::atomic<std::uint64_t> frames_rendered_ = 0;
    std::thread thread_;
};

}  // namespace farlight

// Rig: a lockstep session set up for measuring. It sends only the settings that differ from those
// that hold, and asks for the same camera again and again, or for one that turns into its place.
#pragma once

#include "client/accuracy/progress.h"
#include "client/script/script.h"
#include "client/session.h"

namespace farlight::client {

class Rig {
public:
    /// `degrees_per_frame`: the camera turns by so much a frame and ends at the scene's own pose.
    Rig(const Url& url, const protocol::Hello& hello, Progress& progress,
        double degrees_per_frame = 0);
    ~Rig();
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    const protocol::Welcome& welcome() const { return session_.welcome(); }
    Session& session() { return session_; }

    /// Settings that are not named stay as they are; of those that the server lacks nothing is
    /// said, they are skipped.
    void choose(const Settings& settings);
    /// A frame; `to_go` frames before the camera is in its place. Throws Interrupted.
    Frame draw(bool cut = false, int to_go = 0);
    /// Cuts, then draws `history` frames and one more, which is returned.
    Frame draw_after(int history);
    /// What the view `depth` shows at full size: at most 0 where no surface is; empty where the
    /// server has no such view. Three values a pixel, as a picture.
    std::vector<float> depth();

private:
    Session session_;
    Progress& progress_;
    double degrees_per_frame_;
    Settings held_;
};

/// What one frame is about to cost, in units of one sample a pixel; for the progress bar alone.
double work_of(const Settings& settings);

/// The frame's linear picture at the size it is to be shown at: a smaller one is enlarged
/// bilinearly, as the viewer page does.
Picture linear_picture(const Frame& frame);

/// Bilinear between pixel centres, held at the edges.
Picture enlarged(const Picture& picture, int width, int height);

}  // namespace farlight::client

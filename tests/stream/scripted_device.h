// ScriptedDevice: a renderer that takes as long as a script says, and a Controller on it.
#pragma once

#include "server/stream/controller.h"

#include <functional>
#include <random>
#include <vector>

namespace farlight {

/// What passes cost [ms], and how times scatter. What the passes of a frame that neither samples
/// nor a-trous iterations multiply cost is not what the cost model takes it to be.
struct DeviceSpeed {
    const char* name;
    double fixed;  ///< A frame.
    double gbuffer;  ///< A megapixel.
    double sample;  ///< A megapixel and sample.
    double other_filters;  ///< A megapixel.
    double iteration;  ///< A megapixel and a-trous iteration.
};

/// After README's table of passes: two cores of a CPU; and devices 8 and 200 times as fast in
/// tracing.
constexpr DeviceSpeed kSoftware{"Software", 1, 64, 200, 139, 94};
constexpr DeviceSpeed kSmallGpu{"SmallGpu", 1.5, 3, 25, 4, 1.2};
constexpr DeviceSpeed kLargeGpu{"LargeGpu", 0.6, 0.3, 1, 0.4, 0.1};

struct DrawnFrame {
    double seconds = 0;  ///< When it was begun.
    double ms = 0;
    std::size_t rung = 0;  ///< In effect when it was asked for.
    Choice choice;
};

class ScriptedDevice {
public:
    using Load = std::function<double(double seconds)>;  ///< Factor of all times.

    ScriptedDevice(const DeviceSpeed& speed, const RenderSettings& wishes,
        std::shared_ptr<const FrontierReport> report = nullptr);

    void set_scatter(double share, unsigned seed);  ///< Uniform, +- share.
    /// relMSE of a frame of 1 sample at full size; frames carry estimates of theirs.
    void set_noise(double error) { noise_ = error; }
    void wish(const RenderSettings& wishes, Extent extent = {640, 360});

    /// Draws until `seconds` have passed.
    void draw_for(
        double seconds, const Load& load = [](double) { return 1.0; });

    Controller controller;
    std::vector<DrawnFrame> frames;

private:
    struct Asked {
        RenderSettings settings;
        std::size_t rung;
    };

    void draw_one(const Load& load);
    Asked ask();

    DeviceSpeed speed_;
    RenderSettings wishes_;
    Extent extent_{640, 360};
    double seconds_ = 0;
    double scatter_ = 0;
    double noise_ = 0;
    std::mt19937 random_;
    std::optional<Asked> next_;  ///< Asked for while the one before is drawn, as sessions do.
};

/// Changes of rung between the frames begun in [from, from + 1 s), the most of any `from`.
int most_steps_in_a_second(const std::vector<DrawnFrame>& frames, double from, double to);
/// Frames begun from `from` on that are drawn until the rung changes no more before `to`.
int frames_until_settled(const std::vector<DrawnFrame>& frames, double from, double to);
/// Share of frames longer than the budget.
double missed(const std::vector<DrawnFrame>& frames, double budget_ms);

}  // namespace farlight

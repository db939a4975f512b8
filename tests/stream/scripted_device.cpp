// ScriptedDevice: see the header.
#include "tests/stream/scripted_device.h"

#include <algorithm>

namespace farlight {

ScriptedDevice::ScriptedDevice(const DeviceSpeed& speed, const RenderSettings& wishes,
    std::shared_ptr<const FrontierReport> report)
    : controller(std::move(report))
    , speed_(speed)
{
    wish(wishes);
}

void ScriptedDevice::set_scatter(double share, unsigned seed)
{
    scatter_ = share;
    random_.seed(seed);
}

void ScriptedDevice::wish(const RenderSettings& wishes, Extent extent)
{
    wishes_ = wishes;
    extent_ = extent;
    controller.follow(wishes, extent);
}

ScriptedDevice::Asked ScriptedDevice::ask()
{
    return {controller.settings(false), controller.current().value_or(0)};
}

void ScriptedDevice::draw_for(double seconds, const Load& load)
{
    for (const double end = seconds_ + seconds; seconds_ < end;)
        draw_one(load);
}

void ScriptedDevice::draw_one(const Load& load)
{
    const Asked asked = next_ ? *next_ : ask();
    next_ = ask();
    const Choice choice = choice_of(asked.settings);
    const double pixels = 1e-6 * extent_.width * extent_.height
        * static_cast<double>(choice.resolution_scale)
        * static_cast<double>(choice.resolution_scale);
    const double factor =
        load(seconds_) * (1 + std::uniform_real_distribution(-scatter_, scatter_)(random_));
    const Controller::Time now{std::chrono::microseconds(std::llround(seconds_ * 1e6))};
    DrawnCost cost{choice};
    cost.trace_ms = factor
        * (speed_.fixed + pixels * (speed_.gbuffer + speed_.sample * choice.samples_per_pixel));
    cost.denoise_ms = factor
        * (speed_.fixed
            + pixels * (speed_.other_filters + speed_.iteration * choice.atrous_iterations));
    if (noise_ > 0) {
        const double error = noise_ / choice.samples_per_pixel;
        cost.error = {error, 0.8 * error, 1.2 * error};
    }
    frames.push_back({seconds_, cost.ms(), asked.rung, choice});
    seconds_ += cost.ms() / 1000;
    controller.drawn(cost, now);
    controller.news(now);
}

int most_steps_in_a_second(const std::vector<DrawnFrame>& frames, double from, double to)
{
    std::vector<double> steps;
    for (std::size_t i = 1; i < frames.size(); ++i)
        if (frames[i].seconds >= from && frames[i].seconds < to
            && frames[i].choice != frames[i - 1].choice)
            steps.push_back(frames[i].seconds);
    int most = 0;
    for (const double first : steps)
        most = std::max(most,
            static_cast<int>(std::count_if(steps.begin(), steps.end(),
                [&](double step) { return step >= first && step < first + 1; })));
    return most;
}

int frames_until_settled(const std::vector<DrawnFrame>& frames, double from, double to)
{
    int drawn = 0;
    int settled = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (frames[i].seconds < from || frames[i].seconds >= to)
            continue;
        if (frames[i].choice != frames[i - 1].choice)
            settled = drawn;
        ++drawn;
    }
    return settled;
}

double missed(const std::vector<DrawnFrame>& frames, double budget_ms)
{
    const auto over = std::count_if(frames.begin(), frames.end(),
        [&](const DrawnFrame& frame) { return frame.ms > budget_ms; });
    return static_cast<double>(over) / static_cast<double>(frames.size());
}

}  // namespace farlight

// Driving a session, and pictures at full size.
#include "client/accuracy/rig.h"

#include "client/camera_path.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {

Rig::Rig(const Url& url, const protocol::Hello& hello, Progress& progress, double degrees_per_frame)
    : session_(url, hello)
    , progress_(progress)
    , degrees_per_frame_(degrees_per_frame)
{
    for (const nlohmann::json& setting : welcome().settings)
        held_[setting.value("key", "")] = setting.value("value", nlohmann::json());
}

Rig::~Rig()
{
    try {
        session_.close();
    } catch (const std::exception&) {
        return;  // it is over either way
    }
}

void Rig::choose(const Settings& settings)
{
    for (const auto& [key, value] : settings) {
        const auto held = held_.find(key);
        if (held == held_.end() || held->second == value)
            continue;
        session_.set(key, value);
        held->second = value;
    }
}

Frame Rig::draw(bool cut, int to_go)
{
    const Pose pose = degrees_per_frame_ == 0
        ? welcome().camera
        : orbit(welcome().camera, middle_of(welcome().scene), -degrees_per_frame_ * to_go);
    Frame frame = session_.draw(pose, cut);
    progress_.done(work_of(held_));
    return frame;
}

Frame Rig::draw_after(int history)
{
    for (int to_go = history; to_go > 0; --to_go)
        draw(to_go == history, to_go);
    return draw(history == 0);
}

std::vector<float> Rig::depth()
{
    const auto view = held_.find("view");
    if (view == held_.end())
        return {};
    const nlohmann::json shown = view->second;
    choose({{"view", "depth"}});
    std::vector<float> depth = linear_picture(draw(/*cut=*/true)).linear;
    choose({{"view", shown}});
    return depth;
}

double work_of(const Settings& settings)
{
    // On llvmpipe the filters of a frame take about as long as two samples a pixel.
    const auto samples = settings.find("samples_per_pixel");
    const auto denoiser = settings.find("denoiser");
    const bool raw = denoiser != settings.end()
        && (denoiser->second == "none" || denoiser->second == "accumulate");
    return (raw ? 0.5 : 2.5) + (samples == settings.end() ? 1.0 : samples->second.get<double>());
}

Picture linear_picture(const Frame& frame)
{
    Picture picture = decode_picture(frame.header, frame.payload);
    const int width = frame.header.full_width;
    const int height = frame.header.full_height;
    if (picture.width == width && picture.height == height)
        return picture;
    return enlarged(picture, width, height);
}

Picture enlarged(const Picture& picture, int width, int height)
{
    Picture large{.width = width, .height = height, .linear = {}, .display = {}};
    large.linear.resize(static_cast<std::size_t>(width) * height * 3);
    /// The two neighbours of a pixel's centre in the small picture, and the second one's weight.
    struct Between {
        int first, second;
        float weight;
    };
    const auto between = [](int at, int small, int full) {
        const double place = (at + 0.5) * small / full - 0.5;
        const int first = static_cast<int>(std::floor(place));
        return Between{std::clamp(first, 0, small - 1), std::clamp(first + 1, 0, small - 1),
            static_cast<float>(place - first)};
    };
    const auto value = [&](int x, int y, int channel) {
        return picture.linear[(static_cast<std::size_t>(y) * picture.width + x) * 3 + channel];
    };
    const auto mix = [](float a, float b, float weight) { return a + weight * (b - a); };
    for (int y = 0; y < height; ++y) {
        const Between row = between(y, picture.height, height);
        for (int x = 0; x < width; ++x) {
            const Between column = between(x, picture.width, width);
            for (int c = 0; c < 3; ++c)
                large.linear[(static_cast<std::size_t>(y) * width + x) * 3 + c] =
                    mix(mix(value(column.first, row.first, c), value(column.second, row.first, c),
                            column.weight),
                        mix(value(column.first, row.second, c), value(column.second, row.second, c),
                            column.weight),
                        row.weight);
        }
    }
    return large;
}

}  // namespace farlight::client

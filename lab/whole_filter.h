// The whole filter of diffuse light, pass after pass, over textures made by hand.
#pragma once

#include "lab/filter_bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace farlight::lab {

constexpr Extent kFiltered{40, 24};

using Texels = std::vector<glm::vec4>;

inline std::size_t place_of(int x, int y)
{
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(kFiltered.width)
        + static_cast<std::size_t>(x);
}

/// Of every pixel of a picture of kFiltered.
template <typename Value> void for_pixels(const Value& value)
{
    for (int y = 0; y < kFiltered.height; ++y)
        for (int x = 0; x < kFiltered.width; ++x)
            value(x, y);
}

/// Everything the filter does to a signal: over time, its variance, and the wavelets, with the
/// feedback of a view.
class WholeFilter {
public:
    /// `surface` of each pixel: what in_surface and prev_surface hold; zero is a miss.
    using Surface = std::function<glm::uvec4(int x, int y)>;

    /// The frame is `shown` of the textures from their top left; after it they hold `beyond`.
    explicit WholeFilter(const Surface& surface, Extent shown = kFiltered, float beyond = 0)
    {
        for (PassBench* bench : {temporal_.get(), variance_.get(), atrous_.get()}) {
            shared::FrameConstants& frame = bench->frame();
            frame.camera.pixel_footprint = 0.01F;  // as in a picture 200 pixels high
            frame.camera.width = frame.prev_camera.width = static_cast<float>(shown.width);
            frame.camera.height = frame.prev_camera.height = static_cast<float>(shown.height);
            frame.extent = {shown.width, shown.height};
            for (const char* light : {"out_light", "out_light_2"})
                bench->fill(light, GL_RGBA32F, glm::vec4(beyond));
            for_pixels([&](int x, int y) { bench->set_bits("in_surface", x, y, surface(x, y)); });
        }
        for (const char* kept : {"first_light", "first_light_2", "even_light", "even_light_2",
                 "odd_light", "odd_light_2"})
            atrous_->fill(kept, GL_RGBA32F, glm::vec4(beyond));
        for (const char* past : {"prev_light", "prev_light_2", "prev_moments", "prev_length",
                 "out_moments", "out_length"})
            temporal_->fill(past, GL_RGBA32F, glm::vec4(beyond));
        for_pixels([&](int x, int y) {
            const bool met = surface(x, y) != glm::uvec4(0);
            temporal_->set_bits("prev_surface", x, y, surface(x, y));
            for (const char* identity : {"in_identity", "prev_identity"})
                temporal_->set_bits(identity, x, y, glm::uvec4(0, 0, 0, met ? 1 : 0));
        });
    }

    /// The filtered picture of a frame that shows `light`; the second signal shows the same.
    const Texels& frame(const Texels& light)
    {
        for (const char* name : {"in_light", "in_light_2"})
            temporal_->set_texels(name, light);
        repeat();
        picture_ = atrous_->read("out_light");
        return picture_;
    }
    /// A frame that shows the light of the last one, of which nobody wants to see the picture.
    void repeat()
    {
        temporal_->constant("history_valid", frames_++ > 0 ? 1 : 0);
        temporal_->run();
        for (const char* input : {"light", "light_2", "moments", "length"})
            variance_->share(in(input), *temporal_, out(input));
        variance_->run();
        for (int step = 1; step <= 16; step *= 2)
            iterate(step);
        temporal_->swap("prev_moments", "out_moments");
        temporal_->swap("prev_length", "out_length");
    }
    /// Of the last frame [frames], where something is met.
    double shortest_history() const
    {
        float shortest = std::numeric_limits<float>::max();
        for (const glm::vec4& texel : temporal_->read("prev_length"))
            shortest = std::min(shortest, texel.x);
        return shortest;
    }
    double longest_history() const
    {
        float longest = 0;
        for (const glm::vec4& texel : temporal_->read("prev_length"))
            longest = std::max(longest, texel.x);
        return longest;
    }
    /// Pixels of the last frame whose mean or variance over time no number says.
    int endless_moments() const
    {
        const Texels moments = temporal_->read("prev_moments");
        return static_cast<int>(std::count_if(moments.begin(), moments.end(),
            [](const glm::vec4& m) { return !std::isfinite(m.x + m.y); }));
    }
    /// Of all frames.
    BadValues bad_values() const
    {
        BadValues met = temporal_->bad_values();
        met.add(variance_->bad_values());
        met.add(atrous_->bad_values());
        return met;
    }

private:
    static std::string in(const char* name) { return std::string("in_") + name; }
    static std::string out(const char* name) { return std::string("out_") + name; }

    /// Taps `step` pixels apart. What the first iteration writes is the next frame's history: none
    /// of the others writes there.
    void iterate(int step)
    {
        const std::string to = step == 1 ? "first_" : step == 2 || step == 8 ? "even_" : "odd_";
        for (const char* light : {"light", "light_2"}) {
            atrous_->share(in(light), step == 1 ? *variance_ : *atrous_, out(light));
            atrous_->share(out(light), *atrous_, to + light);
        }
        atrous_->constant("step_size", step);
        atrous_->run();
        if (step == 1)
            for (const char* light : {"light", "light_2"})
                temporal_->share(std::string("prev_") + light, *atrous_, out(light));
    }

    std::unique_ptr<PassBench> temporal_ = filter_bench("temporal", kFiltered);
    std::unique_ptr<PassBench> variance_ = filter_bench("variance", kFiltered);
    std::unique_ptr<PassBench> atrous_ = filter_bench("atrous", kFiltered);
    Texels picture_;
    int frames_ = 0;
};

}  // namespace farlight::lab

// Shaders that come to a bad value on request, in one pixel of one stage: what a stage works out is
// replaced before the stage looks at it. (lab/poison.h writes past the stage, into its texture.)
#pragma once

#include "server/gl/shader_source.h"
#include "server/render/bad_values.h"

#include <span>
#include <string_view>

namespace farlight::lab {

/// The pixel where it happens.
constexpr int kInjectedX = 9;
constexpr int kInjectedY = 6;

struct Injection {
    std::size_t stage;  ///< STAGE_*, which must count it.
    std::string_view kinds;  ///< By name: what the stage can tell.
    std::string_view file;  ///< Below shaders/.
    std::string_view text;  ///< There once.
    /// In its place; injected(x) is the bad value in that pixel, else x, for numbers and vectors.
    std::string_view instead;
    int frames = 1;  ///< In a row, of which the last counts it.
    bool refines = false;  ///< In a picture that rests.
    bool on_screen = false;  ///< In one that is shown.
};

/// While it lives, shaders compiled anew inject what the seed setting names; seed 0 names nothing.
class InjectingShaders {
public:
    InjectingShaders();
    ~InjectingShaders();
    InjectingShaders(const InjectingShaders&) = delete;
    InjectingShaders& operator=(const InjectingShaders&) = delete;

    static std::span<const Injection> all();
    static std::uint32_t seed(std::size_t injection, BadKind kind)
    {
        return static_cast<std::uint32_t>((injection + 1) * KIND_COUNT)
            + static_cast<std::uint32_t>(kind);
    }

private:
    std::map<std::string, std::string, std::less<>> clean_;
};

}  // namespace farlight::lab

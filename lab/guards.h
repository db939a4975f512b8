// The guards that hard cases hang on, and how to take one out: a case that holds without its guard
// proves nothing.
#pragma once

#include <string_view>
#include <vector>

namespace farlight::lab {

/// A piece of a shader that keeps `cases` from breaking, and what stands there once it is taken
/// out. `text` occurs in `file` exactly once; it is the shader's own text, so that a guard that was
/// rewritten is missed here at once.
struct Guard {
    std::string_view name;
    std::string_view keeps;  ///< Ids of the cases that must fail without it, with spaces.
    std::string_view file;  ///< Below shaders/.
    std::string_view text;
    std::string_view instead;
};

std::vector<Guard> all_guards();

/// Takes `guard` out of the shaders of this process, before anything is compiled. Throws
/// std::runtime_error where its text is not found once.
void take_out(const Guard& guard);

}  // namespace farlight::lab

// The guards that hard cases hang on, and how to take one out: a case that holds without its guard
// proves nothing.
#pragma once

#include <string_view>
#include <vector>

namespace farlight::lab {

/// What keeps cases from breaking. A piece of a shader and what stands there once it is taken out:
/// `text` occurs in `file` exactly once; it is the shader's own text, so that a guard that was
/// rewritten is missed here at once. Or, without a file, a HostGuard (server/host_guard.h) of this
/// name.
struct Guard {
    std::string_view name;
    std::string_view keeps;  ///< Ids of the cases that must fail without it, with spaces.
    std::string_view file = {};  ///< Below shaders/.
    std::string_view text = {};
    std::string_view instead = {};

    bool in_host() const { return file.empty(); }
};

/// Throws std::logic_error where rows and HostGuards do not name the same guards.
std::vector<Guard> all_guards();

/// Takes `guard` out of this process, before anything is compiled or loaded. Throws
/// std::runtime_error where its text is not found once.
void take_out(const Guard& guard);

}  // namespace farlight::lab

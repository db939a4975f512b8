// How a scene file refuses: where (file and JSON pointer), what was found, what was expected.
#pragma once

#include "server/scene/scene_file.h"

#include <new>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace farlight {

/// A value's place in a file. `place / "objects" / 3` steps inwards.
struct ScenePlace {
    std::string file;
    std::string pointer;  ///< JSON pointer (RFC 6901); empty stands for the whole file.

    ScenePlace operator/(std::string_view key) const;
    ScenePlace operator/(std::size_t index) const;
};

/// Throws SceneError `FILE: POINTER: found FOUND, expected EXPECTED`.
[[noreturn]] void refuse(
    const ScenePlace& place, std::string_view found, std::string_view expected);

/// What `load` returns. Memory that is not to be had is a SceneError at `place`, which stands for
/// what is being loaded.
template <typename Load> auto within_memory(const ScenePlace& place, const Load& load)
{
    constexpr const char* kFound = "more than fits in memory";
    constexpr const char* kExpected = "a smaller scene, or a machine with more memory";
    try {
        return load();
    } catch (const std::bad_alloc&) {
        refuse(place, kFound, kExpected);
    } catch (const std::length_error&) {  // a container's own limit
        refuse(place, kFound, kExpected);
    }
}

/// A value as an error message shows it: short, on one line.
std::string describe(const nlohmann::json& value);

/// `text` in double quotes, shortened where it is long; control characters are escaped.
std::string in_quotes(std::string_view text);

}  // namespace farlight

// How a scene file refuses: where (file and JSON pointer), what was found, what was expected.
#pragma once

#include "server/scene/scene_file.h"

#include <nlohmann/json_fwd.hpp>
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

/// A value as an error message shows it: short, on one line.
std::string describe(const nlohmann::json& value);

/// `text` in double quotes, shortened where it is long; control characters are escaped.
std::string in_quotes(std::string_view text);

}  // namespace farlight

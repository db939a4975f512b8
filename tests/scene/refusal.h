// What a SceneError says, for EXPECT_EQ.
#pragma once

#include "server/scene/scene_file.h"

#include <functional>
#include <string>

namespace farlight {

/// The message of the SceneError that `load` throws, without the file's name in front; "loaded" if
/// it throws none.
inline std::string refusal(const std::string& file, const std::function<void()>& load)
{
    try {
        load();
    } catch (const SceneError& error) {
        const std::string message = error.what();
        const std::string prefix = file + ": ";
        return message.starts_with(prefix) ? message.substr(prefix.size())
                                           : "without the file's name: " + message;
    }
    return "loaded";
}

}  // namespace farlight

// Farlight scenes that are wrong in one place, and what the error says.
#pragma once

#include "tests/scene/refusal.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace farlight {

/// Bad scenes are written as merge patches (RFC 7386) onto this one.
inline constexpr const char* kGood = R"({
  "version": 1,
  "materials": {"white": {"albedo": [0.5, 0.5, 0.5]}},
  "objects": [{"name": "ball", "material": "white", "sphere": {"center": [0, 0, 0], "radius": 1}}],
  "camera": {"position": [0, 0, 5], "target": [0, 0, 0]}
})";

inline std::string refusal_of(const std::string& text)
{
    return refusal("bad.json", [&] { parse_scene(text, ".", "bad.json"); });
}

struct BadScene {
    const char* name;
    const char* patch;
    const char* error;
};
inline void PrintTo(const BadScene& bad, std::ostream* out)
{
    *out << bad.patch;
}

/// "loaded" for what is good after all.
inline std::string refusal_of_patch(const char* patch)
{
    nlohmann::json scene = nlohmann::json::parse(kGood);
    scene.merge_patch(nlohmann::json::parse(patch));
    return refusal_of(scene.dump());
}

}  // namespace farlight

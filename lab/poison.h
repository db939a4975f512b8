// Shaders that write one bad pixel on request: the text of every stage's shader, wrapped.
#pragma once

#include "server/gl/shader_source.h"

#include <cstdint>
#include <span>

namespace farlight::lab {

/// NaN, +infinity, -infinity, -1.
constexpr std::uint32_t kPoisonBits[] = {0x7fc00000U, 0x7f800000U, 0xff800000U, 0xbf800000U};
constexpr std::uint32_t kPoisonKinds = 4;

/// The pixel that is poisoned.
constexpr int kPoisonedX = 9;
constexpr int kPoisonedY = 6;

/// A texture that a stage writes.
struct PoisonedStage {
    const char* file;
    const char* output;
    const char* condition;  ///< Under which this run of the shader is meant.
    bool counted;  ///< What is bad there is counted; else it is no light and not counted.
    bool filled;  ///< A later stage fills the hole from around it: from 16 pixels away there is
                  ///< nothing.
    bool bits = false;  ///< The texture holds whole numbers.
    const char* only_with = nullptr;  ///< Macro without which the stage has no such texture.
};

/// While it lives, shaders compiled anew write poison into a pixel of the stage that the seed
/// setting names; seed 0 names none.
class PoisonedShaders {
public:
    PoisonedShaders();
    ~PoisonedShaders();
    PoisonedShaders(const PoisonedShaders&) = delete;
    PoisonedShaders& operator=(const PoisonedShaders&) = delete;

    static std::span<const PoisonedStage> stages();
    static std::uint32_t code(std::size_t stage, std::uint32_t kind)
    {
        return static_cast<std::uint32_t>(stage + 1) * kPoisonKinds + kind;
    }

private:
    std::map<std::string, std::string, std::less<>> clean_;
};

}  // namespace farlight::lab

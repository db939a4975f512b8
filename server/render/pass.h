// A pass of a frame as it is declared: its shader, and the values of the shader's variables by
// their names there.
#pragma once

#include "server/gl/extent.h"
#include "server/gl/program.h"
#include "server/gl/shader_source.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace farlight {

/// A texture of this frame, by its index in the graph.
struct TextureHandle {
    int index = -1;
};

/// What the scene offers to passes that look into it: buffer textures, bound by name where a shader
/// asks for them, and the macros such shaders are compiled with.
struct SceneInputs {
    std::map<std::string, GLuint, std::less<>> buffers;
    Defines defines;

    /// Whether the scene has the effect behind `macro`.
    bool calls_for(std::string_view macro) const
    {
        return std::any_of(
            defines.begin(), defines.end(), [&](const auto& row) { return row.first == macro; });
    }
};

/// A uniform or storage block offered to every pass of the frame, bound where a shader asks for it.
struct BlockInput {
    std::string name;
    GLuint buffer = 0;
};

using Constant = std::variant<int, unsigned, float, glm::vec2, glm::vec3>;

/// One pass while it is being declared. Names are the shader's own.
struct Pass {
    struct Use {
        std::string name;
        TextureHandle texture;
        bool write = false;
    };

    std::string name;
    std::string shader;
    Defines defines;
    std::vector<Use> uses;
    std::vector<std::pair<std::string, Constant>> constants;
    const SceneInputs* scene_inputs = nullptr;
    Extent domain;
    bool waits = false;

    Pass& define(const Defines& more);
    Pass& read(const char* variable, TextureHandle texture);
    Pass& write(const char* variable, TextureHandle texture);
    Pass& constant(const char* variable, Constant value);
    Pass& scene(const SceneInputs& inputs);  ///< `inputs` must outlive the frame.
    /// It reads storage blocks that passes before it write.
    Pass& wait_for_blocks();
    Pass& dispatch(Extent over);  ///< One invocation a pixel, rounded up to whole work groups.
};

/// The GLSL type a constant may be assigned to.
GLenum glsl_type(const Constant& value);

}  // namespace farlight

// PassBench: one shader of a pass on its own, over textures made by hand. For what no scene brings
// about.
#pragma once

#include "server/gl/buffer.h"
#include "server/gl/program.h"
#include "server/gl/texture.h"
#include "server/render/bad_values.h"
#include "shaders/shared/frame_constants.h"

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace farlight::lab {

/// The camera is at the origin, looks along -z, 90 degrees high; nothing has moved.
class PassBench {
public:
    /// Throws ShaderError.
    PassBench(const std::string& shader, const Defines& defines, Extent extent);

    /// A texture filled with `value`, as the shader's variable `name`.
    void fill(const std::string& name, GLenum format, const glm::vec4& value);
    void set_pixel(const std::string& name, int x, int y, const glm::vec4& value);
    /// Likewise of whole numbers.
    void fill_bits(const std::string& name, GLenum format, const glm::uvec4& value);
    void set_bits(const std::string& name, int x, int y, const glm::uvec4& value);
    /// Texels row by row from the top, as read() gives them.
    void set_texels(const std::string& name, const std::vector<glm::vec4>& texels);
    /// A texture of another bench of the same extent, as this shader's variable `name`.
    void share(const std::string& name, const PassBench& other, const std::string& others_name);
    /// Exchanges what two variables are bound to: what was written becomes what was read.
    void swap(const std::string& a, const std::string& b);
    void constant(const std::string& name, std::variant<int, float, glm::vec3> value);

    shared::FrameConstants& frame() { return frame_; }
    /// Runs over the extent.
    void run();
    /// Texels row by row from the top, of a texture of floats.
    std::vector<glm::vec4> read(const std::string& name) const;
    /// Of counter_block, since the bench was made.
    BadValues bad_values() const;

private:
    void bind() const;

    Program program_;
    Extent extent_;
    shared::FrameConstants frame_{};
    Buffer frame_block_;
    Buffer counters_;
    Buffer tiles_;
    std::map<std::string, std::shared_ptr<GpuTexture>> textures_;
};

}  // namespace farlight::lab

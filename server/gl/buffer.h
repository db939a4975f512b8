// Buffer: immutable-size GPU memory, optionally seen as a buffer texture (samplerBuffer).
#pragma once

#include <cstddef>
#include <epoxy/gl.h>
#include <span>
#include <string>

namespace farlight {

/// Why buffer textures: llvmpipe gathers a texel of 16 bytes at once, but reads storage blocks a
/// word and a lane at a time (measured on Mesa 22.3.6; see tests/bench/results).
class Buffer {
public:
    /// `bytes` may be empty: then 16 zero bytes are allocated, so that shaders may bind it.
    Buffer(const std::string& label, std::span<const std::byte> bytes);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    GLuint id() const { return id_; }
    std::size_t size() const { return size_; }
    /// Replaces the content from `offset` on; what is there must fit into size().
    void update(std::span<const std::byte> bytes, std::size_t offset = 0);
    /// The buffer as a texture of `format` texels (GL_RGBA32F, GL_RGBA32UI, ...); made at first
    /// use.
    GLuint texture(GLenum format);

private:
    GLuint id_ = 0;
    GLuint texture_ = 0;
    std::size_t size_ = 0;
};

}  // namespace farlight

// Immutable storage and its view as a buffer texture.
#include "server/gl/buffer.h"

#include <cassert>
#include <utility>

namespace farlight {

Buffer::Buffer(const std::string& label, std::span<const std::byte> bytes)
{
    static constexpr std::byte kNothing[16]{};
    if (bytes.empty())
        bytes = kNothing;
    size_ = bytes.size();
    glCreateBuffers(1, &id_);
    glNamedBufferStorage(
        id_, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_DYNAMIC_STORAGE_BIT);
    glObjectLabel(GL_BUFFER, id_, -1, label.c_str());
}

Buffer::~Buffer()
{
    glDeleteTextures(1, &texture_);
    glDeleteBuffers(1, &id_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : id_(std::exchange(other.id_, 0))
    , texture_(std::exchange(other.texture_, 0))
    , size_(other.size_)
{
}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    std::swap(id_, other.id_);
    std::swap(texture_, other.texture_);
    std::swap(size_, other.size_);
    return *this;
}

void Buffer::update(std::span<const std::byte> bytes, std::size_t offset)
{
    assert(offset + bytes.size() <= size_);
    glNamedBufferSubData(
        id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

GLuint Buffer::texture(GLenum format)
{
    if (texture_ == 0) {
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture_);
        glTextureBuffer(texture_, format, id_);
    }
    return texture_;
}

}  // namespace farlight

// Pixel buffer, fence, and dropping the alpha channel.
#include "server/render/readback.h"

#include "server/gl/gl_error.h"

#include <cassert>
#include <cstring>

namespace farlight {
namespace {

/// Longer than any frame: a device that has not answered by then is gone [ns].
constexpr GLuint64 kPatience = 60'000'000'000;

template <std::size_t kFrom, std::size_t kTo> void drop_alpha(const std::byte* from, Image& image)
{
    const std::size_t pixels = image.bytes.size() / kTo;
    for (std::size_t i = 0; i < pixels; ++i)
        std::memcpy(&image.bytes[i * kTo], from + i * kFrom, kTo);
}

}  // namespace

Readback::~Readback()
{
    glDeleteSync(fence_);
    glDeleteBuffers(1, &buffer_);
}

void Readback::begin(const GpuTexture& texture)
{
    assert(fence_ == nullptr && "finish() the frame before");
    extent_ = texture.extent();
    format_ = texture.format() == GL_RGBA8 ? PixelFormat::kRgb8 : PixelFormat::kRgb32f;
    const GLsizeiptr texel = format_ == PixelFormat::kRgb8 ? 4 : 16;
    const GLsizeiptr size = texel * extent_.width * extent_.height;
    if (size != buffer_size_) {
        glDeleteBuffers(1, &buffer_);
        glCreateBuffers(1, &buffer_);
        glNamedBufferStorage(buffer_, size, nullptr, GL_MAP_READ_BIT);
        glObjectLabel(GL_BUFFER, buffer_, -1, "readback");
        buffer_size_ = size;
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
    glGetTextureImage(texture.id(), 0, GL_RGBA,
        format_ == PixelFormat::kRgb8 ? GL_UNSIGNED_BYTE : GL_FLOAT, static_cast<GLsizei>(size),
        nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
}

Image Readback::finish()
{
    const GLenum status = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kPatience);
    glDeleteSync(fence_);
    fence_ = nullptr;
    if (status == GL_TIMEOUT_EXPIRED || status == GL_WAIT_FAILED)
        throw GlError("the device did not finish a frame within 60 s");

    Image image{extent_, format_, {}};
    image.bytes.resize(static_cast<std::size_t>(extent_.width)
        * static_cast<std::size_t>(extent_.height) * bytes_per_pixel(format_));
    const void* mapped = glMapNamedBufferRange(buffer_, 0, buffer_size_, GL_MAP_READ_BIT);
    if (mapped == nullptr)
        throw GlError("the frame's pixels could not be mapped");
    if (format_ == PixelFormat::kRgb8)
        drop_alpha<4, 3>(static_cast<const std::byte*>(mapped), image);
    else
        drop_alpha<16, 12>(static_cast<const std::byte*>(mapped), image);
    glUnmapNamedBuffer(buffer_);
    return image;
}

}  // namespace farlight

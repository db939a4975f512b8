// Readback: pixels from the GPU without stalling it. begin() after the frame's commands, finish()
// when wanted.
#pragma once

#include "server/gl/texture.h"
#include "server/render/image.h"

#include <epoxy/gl.h>

namespace farlight {

class Readback {
public:
    Readback() = default;
    ~Readback();
    Readback(const Readback&) = delete;
    Readback& operator=(const Readback&) = delete;

    /// Starts copying an rgba8 or rgba32f texture into a pixel buffer.
    void begin(const GpuTexture& texture);
    /// Waits for the copy; drops the alpha channel. Throws GlError if the device does not answer.
    Image finish();

private:
    GLuint buffer_ = 0;
    GLsizeiptr buffer_size_ = 0;
    GLsync fence_ = nullptr;
    Extent extent_;
    PixelFormat format_ = PixelFormat::kRgb8;
};

}  // namespace farlight

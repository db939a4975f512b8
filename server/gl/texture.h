// GpuTexture: a 2D image without mip levels, the only kind the frame needs.
#pragma once

#include "server/gl/extent.h"

#include <epoxy/gl.h>
#include <string>

namespace farlight {

/// Shaders fetch texels by number and filter them themselves. All our textures have one sampler
/// state, because llvmpipe compiles a program once for each that it meets (sampler_slots.h).
void set_sampler_of_texels(GLuint texture);

class GpuTexture {
public:
    /// Zero-filled. Throws GlError if the device has no room.
    GpuTexture(const std::string& label, GLenum format, Extent extent);
    ~GpuTexture();
    GpuTexture(const GpuTexture&) = delete;
    GpuTexture& operator=(const GpuTexture&) = delete;

    GLuint id() const { return id_; }
    GLenum format() const { return format_; }
    Extent extent() const { return extent_; }
    /// Debuggers and error logs show textures by this name.
    void relabel(const std::string& label);

private:
    GLuint id_ = 0;
    GLenum format_;
    Extent extent_;
};

}  // namespace farlight

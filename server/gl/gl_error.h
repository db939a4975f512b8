// What can go wrong with a device, a shader or the context, as exceptions.
#pragma once

#include <stdexcept>
#include <string>

namespace farlight {

/// No usable device, or the selector names none; what() lists what was tried and why each failed.
struct DeviceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A shader that does not compile or link, or a pass that does not fit its shader.
struct ShaderError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// OpenGL reported an error, or the context is lost.
struct GlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The device has no room for what was asked; everything else goes on.
struct MemoryError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws MemoryError on GL_OUT_OF_MEMORY, else GlError naming `where` if OpenGL has an error
/// pending or the context was reset.
void check_gl(const std::string& where);

}  // namespace farlight

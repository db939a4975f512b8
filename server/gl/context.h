// Context: OpenGL 4.5 core on a headless EGL display, made current on the calling thread.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

/// One way to get OpenGL on this machine.
struct DeviceDescription {
    std::string selector;  ///< What --device takes: "gpu:0", "gpu:1", ..., "software".
    std::string name;  ///< GL_RENDERER, or the EGL device's name when no context could be made.
    std::string version;  ///< GL_VERSION.
    bool software = false;
    std::string problem;  ///< Why it cannot be used; empty: it can.
};

/// Every EGL device and Mesa's surfaceless platform, each tried with a real context.
std::vector<DeviceDescription> list_devices();

class Context {
public:
    /// `selector`: "auto" (first hardware device, else software), "software", "gpu" (first) or
    /// "gpu:N". Throws DeviceError that says what was tried. Debug builds get a debug context whose
    /// errors throw.
    explicit Context(std::string_view selector);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const DeviceDescription& device() const { return device_; }

    /// A second context on the same device that shares programs, buffers and textures with this
    /// one. Current on no thread: call make_current() on the one that is to use it, and destroy it
    /// there. This context must outlive it. Throws DeviceError.
    std::unique_ptr<Context> shared() const;
    void make_current() const;

private:
    Context() = default;

    void* display_ = nullptr;
    void* context_ = nullptr;
    DeviceDescription device_;
};

}  // namespace farlight

// EGL without a display: platform-device for hardware, Mesa's surfaceless platform for software.
#include "server/gl/context.h"

#include "server/gl/gl_error.h"
#include "server/gl/sampler_slots.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <spdlog/spdlog.h>

namespace farlight {
namespace {

/// A place a context may come from: an EGL device, or the surfaceless platform (device == nullptr).
struct Candidate {
    std::string selector;
    EGLDeviceEXT device = nullptr;
};

struct OpenContext {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    DeviceDescription description;
};

bool is_software_renderer(std::string_view renderer)
{
    return renderer.find("llvmpipe") != std::string_view::npos
        || renderer.find("softpipe") != std::string_view::npos
        || renderer.find("SwiftShader") != std::string_view::npos;
}

// NOLINTNEXTLINE(readability-function-size): OpenGL fixes the parameters.
void GLAPIENTRY log_debug_message(
    GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message, const void*)
{
    if (type == GL_DEBUG_TYPE_ERROR)
        spdlog::error("OpenGL: {}", message);
    else if (severity == GL_DEBUG_SEVERITY_HIGH)
        spdlog::warn("OpenGL: {}", message);
}

/// Hardware devices first, as EGL lists them, then the surfaceless platform.
std::vector<Candidate> candidates()
{
    std::vector<Candidate> found;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")
        || epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
        EGLDeviceEXT devices[32];
        EGLint count = 0;
        if (eglQueryDevicesEXT(32, devices, &count) == EGL_TRUE)
            for (EGLint i = 0; i < count; ++i) {
                const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
                if (extensions == nullptr
                    || std::string_view(extensions).find("MESA_device_software")
                        == std::string_view::npos)
                    found.push_back({"gpu:" + std::to_string(found.size()), devices[i]});
            }
    }
    found.push_back({"software", nullptr});
    return found;
}

EGLDisplay display_of(const Candidate& candidate)
{
    if (candidate.device != nullptr)
        return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, candidate.device, nullptr);
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLContext create_context(EGLDisplay display, EGLContext shared_with)
{
#ifdef NDEBUG
    constexpr EGLint kDebug = EGL_FALSE;
#else
    constexpr EGLint kDebug = EGL_TRUE;
#endif
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_CONTEXT_OPENGL_DEBUG, kDebug, EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
        EGL_LOSE_CONTEXT_ON_RESET, EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, shared_with, attributes);
    if (context != EGL_NO_CONTEXT)
        return context;
    const EGLint without_reset[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, shared_with, without_reset);
}

void close_context(const OpenContext& open)
{
    if (open.display == EGL_NO_DISPLAY)
        return;
    eglMakeCurrent(open.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (open.context != EGL_NO_CONTEXT)
        eglDestroyContext(open.display, open.context);
}

/// Makes a context current, or says in description.problem why that failed.
OpenContext open_context(const Candidate& candidate)
{
    OpenContext open;
    open.description.selector = candidate.selector;
    open.description.software = candidate.device == nullptr;
    open.description.name =
        candidate.device == nullptr ? "Mesa surfaceless platform" : "EGL device";
    std::string& problem = open.description.problem;

    const EGLDisplay display = display_of(candidate);
    if (display == EGL_NO_DISPLAY)
        return problem = "EGL has no such platform", open;
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        return problem = "EGL could not be initialised on it", open;
    open.display = display;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
        return problem = "it has no desktop OpenGL", open;
    open.context = create_context(display, EGL_NO_CONTEXT);
    if (open.context == EGL_NO_CONTEXT)
        return problem = "it has no OpenGL 4.5 core", open;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, open.context) != EGL_TRUE)
        return problem = "a context without a surface cannot be made current", open;
    open.description.name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    open.description.version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    // Mesa's surfaceless platform may find hardware that no EGL device stood for.
    open.description.software = is_software_renderer(open.description.name);
    if (candidate.device != nullptr && open.description.software)
        problem = "it is a software renderer; --device software uses it";
    return open;
}

void log_errors()
{
#ifndef NDEBUG
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(log_debug_message, nullptr);
#endif
}

bool selects(std::string_view selector, const Candidate& candidate)
{
    return selector == "auto" || selector == candidate.selector
        || (selector == "gpu" && candidate.device != nullptr);
}

}  // namespace

void check_gl(const std::string& where)
{
    const GLenum reset = glGetGraphicsResetStatus();
    if (reset != GL_NO_ERROR)
        throw GlError(where + ": the OpenGL context was lost");
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
        while (glGetError() != GL_NO_ERROR) { }
        if (error == GL_OUT_OF_MEMORY)
            throw MemoryError(where + ": the device has no memory left for it");
        char code[16];
        std::snprintf(code, sizeof code, "0x%04x", error);
        throw GlError(where + ": OpenGL error " + code);
    }
}

std::vector<DeviceDescription> list_devices()
{
    std::vector<DeviceDescription> devices;
    for (const Candidate& candidate : candidates()) {
        const OpenContext open = open_context(candidate);
        devices.push_back(open.description);
        close_context(open);
    }
    return devices;
}

Context::Context(std::string_view selector)
{
    std::string tried;
    for (const Candidate& candidate : candidates()) {
        if (!selects(selector, candidate))
            continue;
        OpenContext open = open_context(candidate);
        if (open.description.problem.empty()) {
            if (!tried.empty())
                spdlog::info("devices passed over:{}", tried);
            display_ = open.display;
            context_ = open.context;
            device_ = open.description;
            log_errors();
            if (device_.software)
                settle_sampler_slots();
            return;
        }
        tried += "\n  " + candidate.selector + " (" + open.description.name
            + "): " + open.description.problem;
        close_context(open);
    }
    if (tried.empty())
        throw DeviceError("device '" + std::string(selector)
            + "': no such device, expected auto, software, gpu or gpu:N (see --list-devices)");
    throw DeviceError("no usable device with OpenGL 4.5 core; tried:" + tried);
}

Context::~Context()
{
    close_context({display_, context_, {}});
}

std::unique_ptr<Context> Context::shared() const
{
    auto other = std::unique_ptr<Context>(new Context);
    other->display_ = display_;
    other->device_ = device_;
    other->context_ = create_context(display_, context_);
    if (other->context_ == EGL_NO_CONTEXT)
        throw DeviceError(device_.selector + ": no second context that shares with the first");
    return other;
}

void Context::make_current() const
{
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE
        || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
        throw DeviceError(device_.selector + ": its context cannot be made current");
    log_errors();
    if (device_.software)
        settle_sampler_slots();
}

}  // namespace farlight

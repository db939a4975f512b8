// RenderService: the part of the renderer that streaming needs, so that tests can stand in for it.
#pragma once

#include "server/render/renderer.h"

namespace farlight {

/// Thread-safe. Each function means what it means in Renderer.
class RenderService {
public:
    virtual ~RenderService() = default;
    virtual std::shared_ptr<const RendererDescription> description() const = 0;
    virtual void attach(std::shared_ptr<FrameSource> source) = 0;
    /// May wait for a frame being drawn: never called on the network thread.
    virtual void detach(const std::shared_ptr<FrameSource>& source) = 0;
    virtual void wake() = 0;
    virtual std::string failure() const = 0;
    virtual std::uint64_t frames_rendered() const = 0;
};

}  // namespace farlight

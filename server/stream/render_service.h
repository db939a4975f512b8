// RenderService: the part of the renderer that streaming needs, so that tests can stand in for it.
#pragma once

#include "server/render/renderer.h"

#include <nlohmann/json_fwd.hpp>

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
    /// Draws the scene after a JSON Merge Patch of its document, with `reset` of the document as it
    /// was loaded; returns when the next frame will show it, which may take long. Throws SceneError
    /// and whatever else stands in the way; then the scene stays as it was. Called by one thread.
    virtual void edit(const nlohmann::json& merge_patch, bool reset) = 0;
    virtual std::string failure() const = 0;
    virtual std::uint64_t frames_rendered() const = 0;
    virtual BadValueTotals bad_values() const = 0;
};

}  // namespace farlight

// RendererService: what streaming needs, from the real renderer and the document of its scene.
#pragma once

#include "server/scene/scene_document.h"
#include "server/stream/render_service.h"

#include <utility>

namespace farlight {

/// `renderer` shows the document's scene and must outlive this.
class RendererService : public RenderService {
public:
    RendererService(Renderer& renderer, SceneDocument document)
        : renderer_(renderer)
        , loaded_(document)
        , document_(std::move(document))
    {
    }
    std::shared_ptr<const RendererDescription> description() const override
    {
        return renderer_.description();
    }
    void attach(std::shared_ptr<FrameSource> source) override
    {
        renderer_.attach(std::move(source));
    }
    void detach(const std::shared_ptr<FrameSource>& source) override { renderer_.detach(source); }
    void wake() override { renderer_.wake(); }
    void edit(const nlohmann::json& merge_patch, bool reset) override
    {
        SceneDocument next = (reset ? loaded_ : document_).edited(merge_patch);
        renderer_.replace_scene(next.scene());
        document_ = std::move(next);
    }
    std::string failure() const override { return renderer_.failure(); }
    std::uint64_t frames_rendered() const override { return renderer_.frames_rendered(); }
    BadValueTotals bad_values() const override { return renderer_.bad_values(); }

private:
    Renderer& renderer_;
    const SceneDocument loaded_;
    SceneDocument document_;  ///< After all edits so far. The editing thread's.
};

}  // namespace farlight

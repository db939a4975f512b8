// G-buffer stage: what each pixel's ray meets first.
#pragma once

#include "server/render/frame_graph.h"

namespace farlight {

/// Texture contents: shaders/gbuffer/gbuffer.comp.
struct GBuffer {
    TextureHandle surface;
    TextureHandle identity;
    TextureHandle position;
    TextureHandle albedo;
    TextureHandle emission;
    TextureHandle motion;
    TextureHandle prev_surface;  ///< Last frame's; only with `keep_history`.
    TextureHandle prev_identity;
    bool history_valid = false;
};

/// `keep_history`: a temporal filter will want last frame's surface and identity.
inline GBuffer add_gbuffer(FrameGraph& graph, const SceneInputs& scene, bool keep_history)
{
    GBuffer gbuffer;
    if (keep_history) {
        const History surface = graph.history("gbuffer.surface", GL_RGBA32UI);
        const History identity = graph.history("gbuffer.identity", GL_RGBA32UI);
        gbuffer.surface = surface.current;
        gbuffer.identity = identity.current;
        gbuffer.prev_surface = surface.previous;
        gbuffer.prev_identity = identity.previous;
        gbuffer.history_valid = surface.valid && identity.valid;
    } else {
        gbuffer.surface = graph.create("gbuffer.surface", GL_RGBA32UI);
        gbuffer.identity = graph.create("gbuffer.identity", GL_RGBA32UI);
    }
    gbuffer.position = graph.create("gbuffer.position", GL_RGBA32F);
    gbuffer.albedo = graph.create("gbuffer.albedo", GL_RGBA32F);
    gbuffer.emission = graph.create("gbuffer.emission", GL_RGBA32F);
    gbuffer.motion = graph.create("gbuffer.motion", GL_RGBA32F);
    graph.add_pass("gbuffer", "gbuffer/gbuffer.comp")
        .scene(scene)
        .write("out_surface", gbuffer.surface)
        .write("out_identity", gbuffer.identity)
        .write("out_position", gbuffer.position)
        .write("out_albedo", gbuffer.albedo)
        .write("out_emission", gbuffer.emission)
        .write("out_motion", gbuffer.motion);
    return gbuffer;
}

}  // namespace farlight

// How much a frame may ask for: work, and memory of its view.
#pragma once

#include "server/render/renderer.h"

#include <string>

namespace farlight {

/// Why a request is too much for one frame, or nothing.
std::string too_much_work(const RenderRequest& request);

/// What all views together may hold [bytes]: `chosen`, or if that is 0 what RendererOptions says.
std::size_t memory_for_views(std::size_t chosen, bool software);

/// Says that a picture of `extent` needs more than is left: bytes that it wants, that others hold,
/// and that there are for all.
std::string too_little_memory(
    Extent extent, std::size_t wanted, std::size_t taken, std::size_t for_all);

}  // namespace farlight

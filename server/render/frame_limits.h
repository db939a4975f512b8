// How much a frame may ask for: work, and memory of its view.
#pragma once

#include "server/render/renderer.h"

#include <string>

namespace farlight {

/// Longest a frame may be [path segments]: about a second of a fast GPU, minutes of llvmpipe. One
/// client's frame is drawn in one go, so this also bounds how long the others wait, and keeps clear
/// of drivers' watchdogs.
constexpr double kMostSegments = 1e9;

/// Why a request is too much for one frame, or nothing.
std::string too_much_work(const RenderRequest& request);

/// What all views together may hold [bytes]: `chosen`, or if that is 0 what RendererOptions says.
std::size_t memory_for_views(std::size_t chosen, bool software);

/// Says that a picture of `extent` needs more than is left: bytes that it wants, that others hold,
/// and that there are for all.
std::string too_little_memory(
    Extent extent, std::size_t wanted, std::size_t taken, std::size_t for_all);

}  // namespace farlight

// The viewer page, embedded in the binary at build time from client/web.
#pragma once

#include <span>
#include <string_view>

namespace farlight {

struct ViewerFile {
    std::string_view path;  ///< As in a request: "/", "/viewer.js". The only paths there are.
    std::string_view content_type;
    std::string_view bytes;
};

std::span<const ViewerFile> viewer_files();

}  // namespace farlight

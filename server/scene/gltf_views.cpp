// Plain views lie within their buffers.
#include "server/scene/gltf_views.h"

namespace farlight {

void read_gltf_views(GltfContainer& gltf)
{
    for (const nlohmann::json& view : gltf.list("bufferViews"))
        gltf.views.push_back(gltf.buffers[view["buffer"].get<std::size_t>()].subspan(
            view.value("byteOffset", std::size_t(0)), view["byteLength"].get<std::size_t>()));
}

}  // namespace farlight

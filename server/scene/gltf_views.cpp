// Plain views lie within their buffers; compressed ones are decoded.
#include "server/scene/gltf_views.h"

#include "server/scene/gltf_meshopt.h"

namespace farlight {

namespace {

ByteSpan bytes_of(const GltfContainer& gltf, const nlohmann::json& view)
{
    return gltf.buffers[view["buffer"].get<std::size_t>()].subspan(
        view.value("byteOffset", std::size_t(0)), view["byteLength"].get<std::size_t>());
}

}  // namespace

void read_gltf_views(GltfContainer& gltf)
{
    const nlohmann::json& views = gltf.list("bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
        const nlohmann::json* meshopt = gltf_extension(views[i], "EXT_meshopt_compression");
        if (meshopt == nullptr)
            gltf.views.push_back(bytes_of(gltf, views[i]));
        else
            gltf.views.push_back(gltf.keep(unpack_gltf_meshopt(*meshopt, bytes_of(gltf, *meshopt),
                gltf.root / "bufferViews" / i / "extensions" / "EXT_meshopt_compression")));
    }
}

}  // namespace farlight

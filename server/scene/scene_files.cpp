// Reading once, and saying which part of the scene asked when that fails.
#include "server/scene/scene_files.h"

#include <algorithm>

namespace farlight {

SceneFiles::SceneFiles(std::filesystem::path base_dir) : base_dir_(std::move(base_dir)) { }

void SceneFiles::confine()
{
    const std::lock_guard lock(mutex_);
    confined_ = true;
}

template <typename T>
std::shared_ptr<const T> SceneFiles::read_once(Known<T>& known, const std::string& path,
    const ScenePlace& place, const char* expected, T (*read)(const std::filesystem::path&))
{
    const std::lock_guard lock(mutex_);
    const auto found = known.find(path);
    if (found != known.end())
        return found->second;
    const std::filesystem::path given = path;
    if (confined_
        && (given.is_absolute()
            || std::find(given.begin(), given.end(), std::filesystem::path("..")) != given.end()))
        refuse(place, in_quotes(path), "a file in the scene's own folder or below");
    const std::filesystem::path file = base_dir_ / given;
    if (!std::filesystem::exists(file))
        refuse(place, in_quotes(path) + ", and no such file", expected);
    try {
        return known[path] = within_memory(
                   {file.string(), {}}, [&] { return std::make_shared<const T>(read(file)); });
    } catch (const SceneError& error) {
        if (place.pointer.empty())
            throw;
        throw SceneError(place.file + ": " + place.pointer + ": in " + error.what());
    }
}

std::shared_ptr<const GltfScene> SceneFiles::gltf(const std::string& path, const ScenePlace& place)
{
    if (!is_gltf(path))
        refuse(place, in_quotes(path), "the path of a .gltf or .glb file");
    return read_once(gltf_, path, place, "a .gltf or .glb file", load_gltf);
}

std::shared_ptr<const Image8> SceneFiles::image(const std::string& path, const ScenePlace& place)
{
    return read_once(images_, path, place, "a PNG or JPEG picture", read_image);
}

std::shared_ptr<const EnvironmentFile> SceneFiles::environment(
    const std::string& path, const ScenePlace& place)
{
    return read_once(environments_, path, place, "a .hdr or .exr picture", read_environment_map);
}

}  // namespace farlight

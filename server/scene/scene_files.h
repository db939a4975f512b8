// The files that a Farlight scene names: models, pictures, environments. Each is read once.
#pragma once

#include "server/scene/gltf_file.h"
#include "server/scene/image_file.h"

#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace farlight {

/// May be shared by threads. What was read stays as it was, though the file may change.
class SceneFiles {
public:
    explicit SceneFiles(std::filesystem::path base_dir);

    /// `path` is as the scene says it, relative to the scene's folder; `place` says where it does.
    /// Throws SceneError at `place`, with the file's own error in it; that alone if `place` is the
    /// whole file.
    std::shared_ptr<const GltfScene> gltf(const std::string& path, const ScenePlace& place);
    std::shared_ptr<const Image8> image(const std::string& path, const ScenePlace& place);
    std::shared_ptr<const EnvironmentFile> environment(
        const std::string& path, const ScenePlace& place);

    /// From now on, a file that was not read yet must lie in the scene's folder or below.
    void confine();

private:
    template <typename T> using Known = std::map<std::string, std::shared_ptr<const T>>;

    template <typename T>
    std::shared_ptr<const T> read_once(Known<T>& known, const std::string& path,
        const ScenePlace& place, const char* expected, T (*read)(const std::filesystem::path&));

    std::filesystem::path base_dir_;
    std::mutex mutex_;
    bool confined_ = false;
    Known<GltfScene> gltf_;
    Known<Image8> images_;
    Known<EnvironmentFile> environments_;
};

}  // namespace farlight

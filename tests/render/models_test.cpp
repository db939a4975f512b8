// Files nobody here made are drawn, not only read: every one that loads makes a finite picture of
// something. Which load and what the others say: tests/scene/assimp_models_test.cpp.
#include "server/render/live_scene.h"
#include "tests/support/gl_test.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace farlight {
namespace {

/// The glTF files below `folder`.
std::vector<std::filesystem::path> models_below(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    std::error_code absent;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, absent))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class ModelsTest : public GlTest {
protected:
    RenderedFrame draw(Scene scene)
    {
        const LoadedScene loaded = load_onto_device(std::move(scene));
        ScenePrograms scene_programs(programs_, nullptr, nullptr, {});
        SharedScene shared{programs_, scene_programs, loaded.look,
            static_cast<std::uint32_t>(loaded.gpu->light_count()), true, true};
        shared.gpu = loaded.gpu.get();
        scene_programs.follow(loaded.gpu);
        RenderSettings settings;
        settings.effects = {EffectChoice::Kind::kGeneral, EffectMask::general()};
        View view(shared);
        return view.render(linear_request(*loaded.scene, {24, 16}, settings));
    }

    /// How many models below `folder` were drawn.
    int draw_all(const std::filesystem::path& folder)
    {
        int drawn = 0;
        for (const auto& file : models_below(folder)) {
            SCOPED_TRACE(file.string());
            Scene scene;
            try {
                scene = load_scene(file);
            } catch (const SceneError&) {
                continue;
            }
            const RenderedFrame frame = draw(std::move(scene));
            ++drawn;
            EXPECT_EQ(frame.bad_values.all(), 0U);
            bool differ = false;
            for (int y = 0; y < frame.image.extent.height; ++y)
                for (int x = 0; x < frame.image.extent.width; ++x) {
                    const glm::vec3 color = pixel(frame.image, x, y);
                    EXPECT_TRUE(std::isfinite(color.x + color.y + color.z)) << x << "," << y;
                    differ = differ || color != pixel(frame.image, 0, 0);
                }
            EXPECT_TRUE(differ) << "nothing is to be seen";
        }
        return drawn;
    }

private:
    ProgramCache programs_;  ///< The general ones serve every model.
};

TEST_F(ModelsTest, EveryModelOfAssimpThatLoadsIsDrawn)
{
    const std::filesystem::path folder = "/usr/share/assimp/models/glTF2";
    if (models_below(folder).empty())
        GTEST_SKIP() << "Debian's assimp-testmodels is not installed";
    EXPECT_GT(draw_all(folder), 25);
}

TEST_F(ModelsTest, EverySharedModelIsDrawn)
{
    const std::filesystem::path folder = FARLIGHT_DATA_DIR;  // may be "...-NOTFOUND"
    if (models_below(folder).empty())
        GTEST_SKIP() << "no models in FARLIGHT_DATA_DIR, " << folder;
    EXPECT_GT(draw_all(folder), 0);
}

}  // namespace
}  // namespace farlight

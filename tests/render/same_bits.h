// Subject: a scene drawn with several sets of programs, and the test that all of them write the
// same bits: in every texture of every frame, histories and the picture included.
#pragma once

#include "server/render/live_scene.h"
#include "tests/support/gl_test.h"

#include <random>

namespace farlight {

/// What frames wrote into one texture.
struct WrittenTexels {
    std::string name;
    Extent extent;
    std::vector<float> values;  ///< 4 a texel; integers as their bits.
};

/// A scene on the device that any mask may draw.
class Subject {
public:
    explicit Subject(Scene scene);

    EffectMask mask() const { return scene_programs_.scene_mask(); }

    /// Everything that all frames wrote, to the picture as people see it, while the camera moves a
    /// little and time passes.
    std::vector<WrittenTexels> draw(RenderSettings settings, const EffectChoice& effects) const;

private:
    LoadedScene loaded_;
    ScenePrograms scene_programs_;
    SharedScene shared_;
};

/// `choices` against the general programs.
void expect_as_general(const Subject& subject, const RenderSettings& settings,
    const std::vector<EffectChoice>& choices, const std::string& what);

EffectChoice list(EffectMask mask);
EffectMask random_superset(EffectMask mask, std::mt19937& random);
RenderSettings averaging();

}  // namespace farlight

// What is seen of a scene at a glance.
#include "server/render/scene_look.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

/// Whether a lit object of that material sends any light on.
bool lit_object_scatters(const Material& material)
{
    Scene scene;
    scene.materials = {material};
    scene.objects.push_back({"ball", 0, Sphere{}});
    scene.background = glm::vec3(1);
    return look_of(scene).scatters;
}

TEST(SceneLooks, ScatterWhereAnyLayerSendsLightOn)
{
    const Material black{.name = "black", .albedo = glm::vec3(0)};
    EXPECT_FALSE(lit_object_scatters(black));
    Material one = black;
    one.albedo = {0, 0, 0.5F};
    EXPECT_TRUE(lit_object_scatters(one));
    for (float Material::*layer :
        {&Material::metallic, &Material::specular, &Material::transmission, &Material::clearcoat}) {
        one = black;
        one.*layer = 0.5F;
        EXPECT_TRUE(lit_object_scatters(one));
        one.unlit = true;
        EXPECT_FALSE(lit_object_scatters(one));
    }
}

TEST(SceneLooks, DoNotScatterInTheDark)
{
    Scene scene;
    scene.materials = {{"plain"}};
    scene.objects.push_back({"ball", 0, Sphere{}});
    EXPECT_FALSE(look_of(scene).scatters);
}

}  // namespace
}  // namespace farlight

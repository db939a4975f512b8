// Poison in a picture with everything that can be filtered: diffuse, specular and scattered light.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/poison.h"
#include "lab/statistics.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace farlight::lab {
namespace {

constexpr Extent kSignalsExtent{24, 16};

/// A box of dull metal, filled with thin fog, lit by a lamp; it glows so little that an albedo or
/// an emission of -1 would be less than nothing.
Scene foggy_metal()
{
    Material wall{"wall", glm::vec3(0.9F), glm::vec3(0.02F), true};
    wall.metallic = 0.3F;
    wall.roughness = 0.6F;
    Scene scene = box_of(wall);
    PunctualLight lamp;
    lamp.name = "lamp";
    lamp.intensity = glm::vec3(1);
    lamp.position = {0, 1, 0};
    scene.lights.push_back(lamp);
    scene.medium.sigma_s = glm::vec3(0.2F);
    scene.camera = {{0.3, 0.2, 1.2}, {0, 0, -1}, {0, 1, 0}, 60};
    return scene;
}

/// A frame that `code` poisons, and the one after it.
struct TwoFrames {
    RenderedFrame poisoned;
    RenderedFrame later;
};

TwoFrames seen_with(const DeviceScene& scene, std::uint32_t code, bool with_history)
{
    View view(scene.shared);
    RenderRequest request = linear_request(scene.scene, kSignalsExtent, RenderSettings{});
    for (int i = 0; i < 2 && with_history; ++i)
        view.render(request);
    request.settings.seed = code;
    TwoFrames seen;
    seen.poisoned = view.render(request);
    request.settings.seed = 0;
    seen.later = view.render(request);
    return seen;
}

/// How far the poisoned run is off the clean one [of the mean]: a tap that is left out changes what
/// the rest weighs, no more.
double off_clean(const Image& poisoned, const Image& clean, bool without_poisoned)
{
    double most = 0;
    for (int y = 0; y < kSignalsExtent.height; ++y)
        for (int x = 0; x < kSignalsExtent.width; ++x) {
            if (without_poisoned && x == kPoisonedX && y == kPoisonedY)
                continue;
            for (int c = 0; c < 3; ++c)
                most = farther(most,
                    std::abs(
                        static_cast<double>(pixel(poisoned, x, y)[c] / pixel(clean, x, y)[c] - 1)));
        }
    return most;
}

void every_signal(Findings& findings, Length /*length*/)
{
    const DeviceScene clean(foggy_metal());
    seen_with(clean, 0, true);  // so that its shaders are compiled before they are poisoned
    const PoisonedShaders shaders;
    const DeviceScene poisoned(foggy_metal());
    double others = 0;
    double later = 0;
    int uncounted = 0;
    int counted_later = 0;
    int frames = 0;
    for (std::size_t stage = 0; stage < PoisonedShaders::stages().size(); ++stage)
        for (std::uint32_t kind = 0; kind < kPoisonKinds; ++kind) {
            const bool with_history = (stage + kind) % 2 == 0;
            const std::uint32_t code = PoisonedShaders::code(stage, kind);
            const TwoFrames seen = seen_with(poisoned, code, with_history);
            const TwoFrames expected = seen_with(clean, code, with_history);
            others = farther(others, off_clean(seen.poisoned.image, expected.poisoned.image, true));
            later = farther(later, off_clean(seen.later.image, expected.later.image, false));
            // An albedo of -1 takes the diffuse light away; what else there is remains light.
            const bool dims = kind == kPoisonKinds - 1
                && std::string_view(PoisonedShaders::stages()[stage].output) == "out_albedo";
            const bool counts = PoisonedShaders::stages()[stage].counted && !dims;
            uncounted += counts == (seen.poisoned.bad_values.all() > 0) ? 0 : 1;
            counted_later += seen.later.bad_values.all() == 0 ? 0 : 1;
            ++frames;
        }
    findings.at_most("other pixels off the clean picture [of their value], "
            + std::to_string(frames) + " poisoned frames",
        others, 0.05);
    findings.at_most("any pixel off it a frame later", later, 0.05);
    findings.none("poisoned frames whose counter does not say so", uncounted);
    findings.none("frames that count something a frame later", counted_later);
}

constexpr Case kSignalsCases[] = {
    {"59d", "signals", "poison in specular and scattered light", Layer::kPicture,
        "In a picture with all signals poison stays where it is, is counted, and is gone a frame "
        "later.",
        every_signal},
};

}  // namespace

Group signals_group()
{
    return {kSignalsCases, {}};  // the guards are those of the group poison
}

}  // namespace farlight::lab

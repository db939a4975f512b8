// The registry of effects: what a scene may call for, how that is seen, and the macro that compiles
// it in. What a scene lacks is not compiled, not allocated, not dispatched. To add an effect: one
// row in effects.cpp, one #ifdef in a shader.
//
// A program is right for a scene if its mask contains the scene's. It gives the same bits as any
// other right program, because shaders branch on an effect's neutral value instead of computing
// with it.
#pragma once

#include "server/scene/scene.h"
#include "shaders/shared/scene_layout.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

/// What is left of a scene once packed, in single precision: what has no extent or no power is not
/// there. Each part is counted by whoever packs it.
struct SceneContent {
    std::size_t triangles = 0;
    std::size_t smooth_triangles = 0;  ///< With shading normals of their own.
    std::size_t spheres = 0;
    std::size_t disks = 0;
    std::size_t instances = 0;  ///< Placements of a tree of their own; flattened objects are none.
    std::size_t polygon_lights = 0;
    std::size_t sphere_lights = 0;
    std::size_t disk_lights = 0;
    std::size_t emissive_triangles = 0;  ///< Of meshes, sampled as lights.
    std::size_t delta_lights = 0;  ///< Point, spot and directional lights ever on.
    std::size_t light_tree_nodes = 0;  ///< 0: lights are chosen by the alias table alone.
    /// The first object that is an instance; that is one and moves; that has vertices that move.
    std::optional<std::uint32_t> placed = {};
    std::optional<std::uint32_t> moving = {};
    std::optional<std::uint32_t> deforming = {};
    /// One an object, not 0 where something of it is left; empty: take every object as left.
    std::vector<std::uint8_t> drawn = {};

    bool is_drawn(std::size_t object) const { return drawn.empty() || drawn[object] != 0; }
};

struct Effect {
    std::string_view name;  ///< As in the setting `effects` and shown by `farlight info`.
    std::string_view macro;  ///< Defined in shaders compiled with the effect; empty: passes alone.
    std::string_view disappears;  ///< What is not there without it, for people.
    std::vector<std::string_view> needs;  ///< Effects by name that its code stands on.
    /// Why the scene calls for it ("4 spheres, first 'ground'"), or nothing.
    std::optional<std::string> (*reason)(const Scene& scene, const SceneContent& content);
    std::string_view setting = {};  ///< Called for by this setting instead of by the scene.
};

/// Every effect known, in a fixed order.
const std::vector<Effect>& effect_registry();

/// The setting that calls for the effect; empty: scenes do.
std::string_view setting_of(std::string_view effect);

/// A set of effects.
class EffectMask {
public:
    EffectMask() = default;
    /// Every effect of the registry that has a macro: the general program's.
    static EffectMask general();
    /// The effects called `names`, with all they need. Throws std::invalid_argument naming one that
    /// does not exist.
    static EffectMask of(const std::vector<std::string_view>& names);

    bool contains(EffectMask other) const { return (bits_ & other.bits_) == other.bits_; }
    bool has(std::string_view name_or_macro) const;
    bool empty() const { return bits_ == 0; }
    int size() const;
    std::uint64_t bits() const { return bits_; }
    std::vector<std::string_view> names() const;
    std::vector<std::string_view> macros() const;

    EffectMask operator|(EffectMask other) const { return EffectMask(bits_ | other.bits_); }
    EffectMask without(EffectMask other) const { return EffectMask(bits_ & ~other.bits_); }
    bool operator==(const EffectMask&) const = default;

private:
    friend EffectMask mask_of_row(std::size_t row);
    explicit EffectMask(std::uint64_t bits) : bits_(bits) { }

    std::uint64_t bits_ = 0;  ///< Bit i: row i of the registry.
};

/// The effect of row `row` alone, without what it needs.
EffectMask mask_of_row(std::size_t row);

struct ActiveEffect {
    std::string_view name;
    std::string_view macro;
    std::string reason;
};

/// What the scene calls for, in the registry's order. `scene` should have been through
/// drop_neutral() (scene/neutral.h): else what makes no difference counts.
std::vector<ActiveEffect> active_effects(const Scene& scene, const SceneContent& content);

EffectMask mask_of(const std::vector<ActiveEffect>& effects);

/// Perceptual roughness up to which a reflection or refraction is perfectly sharp. Constant
/// roughness only: what a texture says is held above it.
constexpr float kMirrorRoughness = MIRROR_ROUGHNESS;

}  // namespace farlight

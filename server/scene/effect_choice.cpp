// Text to choice and back.
#include "server/scene/effect_choice.h"

#include <algorithm>
#include <stdexcept>

namespace farlight {

EffectChoice parse_effect_choice(std::string_view text)
{
    if (text == "auto")
        return {};
    if (text == "general")
        return {EffectChoice::Kind::kGeneral, EffectMask::general()};
    std::vector<std::string_view> names;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::string_view name = text.substr(0, comma);
        text.remove_prefix(std::min(comma + 1, text.size()));
        while (name.starts_with(' '))
            name.remove_prefix(1);
        names.push_back(name);
    }
    const EffectMask mask = EffectMask::of(names);
    for (const Effect& effect : effect_registry())
        if (effect.macro.empty() && mask.has(effect.name))
            throw std::invalid_argument("'" + std::string(effect.name)
                + "' is no part of programs, the setting '" + std::string(effect.setting)
                + "' controls it");
    return {EffectChoice::Kind::kList, mask};
}

std::string to_text(const EffectChoice& choice)
{
    if (choice.kind == EffectChoice::Kind::kAuto)
        return "auto";
    if (choice.kind == EffectChoice::Kind::kGeneral)
        return "general";
    std::string text;
    for (const std::string_view name : choice.mask.names())
        text.append(text.empty() ? "" : ",").append(name);
    return text;
}

std::optional<std::string> what_is_missing(
    const EffectChoice& choice, const std::vector<ActiveEffect>& effects)
{
    if (choice.kind != EffectChoice::Kind::kList)
        return std::nullopt;
    std::string missing;
    for (const ActiveEffect& effect : effects)
        if (!choice.mask.has(effect.name))
            missing += (missing.empty() ? "'" : "; '") + std::string(effect.name)
                + "' is missing: " + effect.reason;
    return missing.empty() ? std::nullopt : std::optional(missing);
}

}  // namespace farlight

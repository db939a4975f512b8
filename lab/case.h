// A hard case of the numerical laboratory: an input that breaks renderers, what ours does with it,
// and the bound that this must keep.
#pragma once

#include <concepts>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace farlight::lab {

/// How a case looks at the renderer.
enum class Layer : std::uint8_t {
    kFunction,  ///< A GLSL function against an oracle in double precision.
    kPicture,  ///< A small picture with a known property.
    kSequence,  ///< A scripted sequence against an oracle of reprojection.
    kServer,  ///< A server over a real WebSocket.
};
std::string_view to_text(Layer layer);

/// The one farther off. NaN is infinitely far: std::max would drop it.
template <std::floating_point T> T farther(T most, std::type_identity_t<T> off)
{
    return off <= most ? most : off > most ? off : std::numeric_limits<T>::infinity();
}

/// One number that a case measured and the bound that it must keep.
struct Measurement {
    std::string what;  ///< With its unit.
    double measured = 0;
    double bound = 0;
    bool upper = true;  ///< The bound is the most it may be, else the least.
    bool known = false;  ///< It is broken, as it is known to be.

    /// NaN keeps no bound.
    bool holds() const { return upper ? measured <= bound : measured >= bound; }
    /// Share of the bound that is left, negative where it is broken; of the bound 0: 1 or -1; on
    /// the bound, as counts are that must be exact: 1.
    double margin() const;
};

/// What a case has found, in the order of its measurements.
class Findings {
public:
    void at_most(std::string what, double measured, double bound)
    {
        all_.push_back({std::move(what), measured, bound, true});
    }
    void at_least(std::string what, double measured, double bound)
    {
        all_.push_back({std::move(what), measured, bound, false});
    }
    /// For counts of what must not happen.
    void none(std::string what, double measured) { at_most(std::move(what), measured, 0); }
    /// What `because` says keeps the bound from being kept: no failure of a run as long as it is no
    /// worse than `at_worst`. It is counted all the same.
    void known_to_fail(const std::string& what, double measured, double bound, double at_worst,
        std::string because)
    {
        const bool known = measured > bound && measured <= at_worst;
        all_.push_back({what, measured, bound, true, known});
        reason_ = known ? std::move(because) : reason_;
    }

    std::span<const Measurement> all() const { return all_; }
    /// Of what is known to fail; else empty.
    const std::string& reason() const { return reason_; }
    /// The measurement that decides: a broken one if there is one, else that of the least margin;
    /// nullptr without any.
    const Measurement* decisive() const;
    /// Whether all hold but for what is known to fail.
    bool hold() const;

private:
    std::vector<Measurement> all_;
    std::string reason_;
};

/// Short forms run with every test run, long ones by name.
enum class Length : std::uint8_t { kShort, kLong };

struct Case {
    std::string_view id;  ///< Number in the laboratory's list, or M and the number of a law.
    std::string_view group;
    std::string_view name;
    Layer layer;
    std::string_view claim;  ///< What must hold, in one sentence.
    void (*run)(Findings& findings, Length length);
};

/// All cases, by number. The files cases_*.cpp hold a group each.
std::vector<Case> all_cases();

}  // namespace farlight::lab

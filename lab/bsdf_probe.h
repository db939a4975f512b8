// Draws from one material seen at one angle and sums its density over bins: how samplers of BSDFs
// are tested.
#pragma once

#include "lab/bsdf_cases.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

namespace farlight {

/// Macros of the effects to compile.
using BsdfMacros = std::vector<std::string_view>;

/// Every effect.
BsdfMacros general_macros();

enum class BsdfProbe : std::uint8_t {
    kSamples,  ///< Two texels a sample: wi and 1, 2 (of a delta lobe) or 0 (none); weight and pdf.
    kValues,  ///< Two texels a random direction: diffuse value and pdf; specular value.
    kAgreement,  ///< A texel a sample: |weight * pdf / value - 1|, largest weight, probability of
                 ///< the least likely lobe, 1 where something is not finite or negative.
    kDensity,  ///< A texel a bin: pdf and value integrated over it.
};

/// The texels of `count` samples, directions or bins, on the device.
std::vector<glm::vec4> probe_bsdf(
    const BsdfCase& c, const BsdfMacros& macros, BsdfProbe probe, std::size_t count);

struct BsdfDraw {
    glm::dvec3 wi;
    glm::dvec3 weight;
    double pdf = 0;
    bool usable = false;
    bool delta = false;
};

/// Samples of the general program.
std::vector<BsdfDraw> draw_bsdf(const BsdfCase& c, std::size_t count);

struct BsdfFit {
    double p_value = 0;  ///< Of as much disagreement as there is between samples and density.
    double total = 0;  ///< What the density integrates to.
};

/// Chi-squared of `count` samples against the density, over bins that follow the sharpest lobe.
BsdfFit fit_of_samples(const BsdfCase& c, std::size_t count);

}  // namespace farlight

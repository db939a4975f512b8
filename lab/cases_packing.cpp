// Directions as files have them and as textures and buffers hold them.
#include "lab/evaluate.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "server/scene/mesh_repair.h"
#include "server/scene/texels.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace farlight::lab {
namespace {

/// Normals as files have them; what is left has a direction.
void vectors_without_direction(Findings& findings, Length /*length*/)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec3> bad{{0, 0, 0}, {-0.0F, 0, 0}, {1e-45F, 0, 0}, {1e-45F, 3e-45F, 0},
        {1e-40F, 1e-39F, 1e-40F}, {kNan, 0, 1}, {kInfinity, 0, 0}, {3e38F, 3e38F, 3e38F}};
    const std::vector<glm::vec3> good{
        {1.2e-38F, 0, 0}, {0, 2e-20F, 0}, {0, 0, 2e38F}, {1e30F, 1, 0}};
    double off = 0;
    const auto repaired = [&](const std::vector<glm::vec3>& normals) {
        Mesh mesh = bumpy_sphere(24, 12);
        mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
        std::copy(normals.begin(), normals.end(), mesh.normals.begin());
        const MeshRepairs repairs = repair_mesh(mesh);
        for (const glm::vec3& normal : mesh.normals)
            off = farther(off, std::abs(glm::length(glm::dvec3(normal)) - 1));
        return static_cast<double>(repairs.replaced_normals);
    };
    findings.none(
        "normals without direction that are kept", static_cast<double>(bad.size()) - repaired(bad));
    findings.none("normals with a direction that are replaced", repaired(good));
    findings.at_most("length of a normal off 1", off, 1e-6);
}

/// The nearest code is up to half a step of 1 / 32767 off on either axis, which turns a direction
/// by up to 3 sqrt(2) times as much (in the middle of a face of the octahedron).
constexpr double kCodeError = 0.5 / 32767 * 3 * std::numbers::sqrt2 + 1e-6;

void octahedral_codes(Findings& findings, Length length)
{
    std::vector<glm::uvec4> rows;
    std::mt19937 random(58);
    const std::uint32_t step = length == Length::kLong ? 1 : 257;
    for (std::uint32_t code = 0; code < 0x10000; code += step)
        for (const std::uint32_t other : {0U, 1U, 0x7fffU, 0x8000U, 0x8001U, 0xffffU, code,
                 0x7fffU - code % 0x8000U, static_cast<std::uint32_t>(random() % 0x10000)})
            for (const bool swapped : {false, true})
                rows.emplace_back(swapped ? code << 16U | other : other << 16U | code, 0, 0, 0);
    double none = 0;
    double again = 0;
    for (const glm::vec4& r :
        evaluate({"#include \"lib/numbers.glsl\"\n#include \"lib/packing.glsl\"", R"(
    const vec3 n = unpack_octahedral(x_bits.x);
    result.x = all_finite(n) && abs(length(n) - 1.0) <= 1e-6 ? 0.0 : 1.0;
    result.y = length(unpack_octahedral(pack_octahedral(n)) - n);
)",
                     {}},
            rows)) {
        none += static_cast<double>(r.x);
        again = farther(again, static_cast<double>(r.y));
    }
    findings.none("codes that decode to no unit vector", none);
    findings.at_most("code packed again off itself", again, kCodeError);
}

/// Axes, the seams of the octahedron, and anywhere.
std::vector<glm::vec4> unit_vectors()
{
    std::vector<glm::vec4> vectors;
    for (const float x : {-1.0F, -0.0F, 0.0F, 1e-20F, 0.5F, 1.0F})
        for (const float y : {-1.0F, -0.0F, 0.0F, -1e-20F, 0.5F, 1.0F})
            for (const float z : {-1.0F, -1e-20F, -0.0F, 0.0F, 1e-20F, 1.0F})
                if (x * x + y * y + z * z > 0.1F)
                    vectors.emplace_back(glm::vec3(glm::normalize(glm::dvec3(x, y, z))), 0);
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 30'000; ++i)
        vectors.emplace_back(
            glm::normalize(glm::vec3(normal(random), normal(random), normal(random))), 0);
    return vectors;
}

void octahedral_vectors(Findings& findings, Length /*length*/)
{
    std::vector<glm::vec4> vectors = unit_vectors();
    for (glm::vec4& vector : vectors)
        vector.w = glm::uintBitsToFloat(pack_octahedral(glm::vec3(vector)));
    double off = 0;
    double host_off = 0;
    for (const glm::vec4& r : evaluate({"#include \"lib/packing.glsl\"", R"(
    result.x = length(unpack_octahedral(pack_octahedral(x.xyz)) - x.xyz);
    result.y = length(unpack_octahedral(x_bits.w) - x.xyz);
)",
                                           {}},
             vectors)) {
        off = farther(off, static_cast<double>(r.x));
        host_off = farther(host_off, static_cast<double>(r.y));
    }
    findings.at_most("vector packed by the device off itself", off, kCodeError);
    findings.at_most("vector packed by the host off itself", host_off, kCodeError);
}

constexpr Case kPackingCases[] = {
    {"58", "packing", "vectors without direction", Layer::kFunction,
        "Normals of no length, a denormal one or none that is finite are replaced, others are made "
        "unit.",
        vectors_without_direction},
    {"58b", "packing", "octahedral codes", Layer::kFunction,
        "Every code is a unit vector and stays the same when packed again.", octahedral_codes},
    {"58c", "packing", "octahedral vectors", Layer::kFunction,
        "A unit vector, packed by device or host, is the same within half a step of its code.",
        octahedral_vectors},
};

constexpr Guard kPackingGuards[] = {
    {"least_direction", "58"},
    {"fold_without_sign_of_zero", "58c", "lib/packing.glsl",
        "vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);", "sign(p);"},
    {"codes_are_made_unit", "58b", "lib/packing.glsl", "return normalize(n);", "return n;"},
};

}  // namespace

Group packing_group()
{
    return {kPackingCases, kPackingGuards};
}

}  // namespace farlight::lab

// Gathering, dropping and splitting vertices.
#include "server/scene/mesh_vertices.h"

#include <limits>
#include <numeric>

namespace farlight {

void gather_vertices(Mesh& mesh, const std::vector<std::uint32_t>& from)
{
    const auto gather = [&](auto& list) {
        if (list.empty())
            return;
        std::remove_reference_t<decltype(list)> gathered;
        gathered.reserve(from.size());
        for (const std::uint32_t vertex : from)
            gathered.push_back(list[vertex]);
        list = std::move(gathered);
    };
    gather(mesh.positions);
    gather(mesh.normals);
    gather(mesh.uvs[0]);
    gather(mesh.uvs[1]);
    gather(mesh.tangents);
    gather(mesh.colors);
    gather(mesh.joints);
    gather(mesh.weights);
    for (MorphTarget& target : mesh.morph_targets) {
        gather(target.positions);
        gather(target.normals);
    }
}

void drop_unused_vertices(Mesh& mesh)
{
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> moved(mesh.positions.size(), kUnused);
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            moved[triangle[corner]] = 0;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < moved.size(); ++i)
        if (moved[i] != kUnused) {
            moved[i] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(i);
        }
    if (kept.size() == moved.size())
        return;
    gather_vertices(mesh, kept);
    for (glm::uvec3& triangle : mesh.triangles)
        triangle = {moved[triangle.x], moved[triangle.y], moved[triangle.z]};
}

void split_vertices(Mesh& mesh, const std::function<bool(std::size_t triangle)>& is_second_kind)
{
    const std::size_t before = mesh.positions.size();
    std::vector<bool> of_first_kind(before, false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (!is_second_kind(i))
            for (int corner = 0; corner < 3; ++corner)
                of_first_kind[mesh.triangles[i][corner]] = true;

    std::vector<std::uint32_t> from(before);
    std::iota(from.begin(), from.end(), 0U);
    std::vector<std::uint32_t> twin(before, 0);  // 0: none yet
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (is_second_kind(i))
            for (int corner = 0; corner < 3; ++corner) {
                std::uint32_t& vertex = mesh.triangles[i][corner];
                if (!of_first_kind[vertex])
                    continue;
                if (twin[vertex] == 0) {
                    twin[vertex] = static_cast<std::uint32_t>(from.size());
                    from.push_back(vertex);
                }
                vertex = twin[vertex];
            }
    if (from.size() != before)
        gather_vertices(mesh, from);
}

}  // namespace farlight

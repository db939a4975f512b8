// See the header.
#include "client/cli/bad_values.h"

#include <algorithm>
#include <cstdio>

namespace farlight::client {

void BadValuesMet::add(const protocol::FrameHeader& header)
{
    for (const protocol::StageEntry& stage : header.stages) {
        auto row = std::find_if(
            rows_.begin(), rows_.end(), [&](const Row& r) { return r.stage == stage.name; });
        if (row == rows_.end()) {
            row = rows_.insert(rows_.end(), {stage.name, {}});
            protocol::StageEntry::each_count(
                stage, [&](auto, std::string_view kind) { row->kinds.emplace_back(kind, 0); });
        }
        std::size_t kind = 0;
        protocol::StageEntry::each_count(stage,
            [&](std::uint32_t count, std::string_view) { row->kinds[kind++].second += count; });
    }
}

std::string BadValuesMet::to_text() const
{
    if (rows_.empty())
        return "  no non-finite, negative or clamped values\n";
    std::string text = "  bad values by stage [pixels]  ";
    char cell[32];
    for (const auto& [kind, count] : rows_.front().kinds) {
        std::snprintf(cell, sizeof cell, "%10s", std::string(kind).c_str());
        text += cell;
    }
    text += "\n";
    for (const Row& row : rows_) {
        text +=
            "  " + row.stage + std::string(28 - std::min<std::size_t>(row.stage.size(), 27), ' ');
        for (const auto& [kind, count] : row.kinds) {
            std::snprintf(cell, sizeof cell, "%10llu", static_cast<unsigned long long>(count));
            text += cell;
        }
        text += "\n";
    }
    return text;
}

nlohmann::json BadValuesMet::to_json() const
{
    nlohmann::json json = nlohmann::json::object();
    for (const Row& row : rows_)
        for (const auto& [kind, count] : row.kinds)
            json[row.stage][std::string(kind)] = count;
    return json;
}

}  // namespace farlight::client

// What frames say of values that no healthy frame has, added up.
#pragma once

#include "protocol/frame_header.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace farlight::client {

class BadValuesMet {
public:
    void add(const protocol::FrameHeader& header);

    /// A line where there were none, else a table: stages that met some, by kind.
    std::string to_text() const;
    /// {stage: {kind: pixels}}, empty where there were none.
    nlohmann::json to_json() const;

private:
    struct Row {
        std::string stage;
        std::vector<std::pair<std::string_view, std::uint64_t>> kinds;
    };
    std::vector<Row> rows_;  ///< In the order in which stages were first met.
};

}  // namespace farlight::client

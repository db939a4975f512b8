// PROTOCOL.md taken apart: its fenced examples and its tables, for the tests that hold page and
// code together.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace farlight {

struct ProtocolDocument {
    /// One table row, cells trimmed, backticks removed from the first cell only.
    using Row = std::vector<std::string>;

    std::map<std::string, std::vector<std::string>>
        examples;  ///< Info string -> contents of the blocks.
    /// Heading and, for later tables, the emphasised word that opens them ("welcome",
    /// "welcome/pose") -> rows below the heading row.
    std::map<std::string, std::vector<Row>> tables;
};

/// Throws std::runtime_error when the file cannot be read.
ProtocolDocument read_protocol_document();

}  // namespace farlight

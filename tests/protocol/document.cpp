// Reads the little of Markdown that PROTOCOL.md uses.
#include "tests/protocol/document.h"

#include <fstream>
#include <stdexcept>

namespace farlight {
namespace {

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? ""
                                      : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

ProtocolDocument::Row cells_of(const std::string& line)
{
    ProtocolDocument::Row cells;
    for (std::size_t at = 1; at < line.size();) {
        const auto bar = line.find('|', at);
        cells.push_back(trimmed(line.substr(at, bar - at)));
        at = bar == std::string::npos ? bar : bar + 1;
    }
    return cells;
}

}  // namespace

ProtocolDocument read_protocol_document()
{
    std::ifstream file(FARLIGHT_SOURCE_DIR "/protocol/PROTOCOL.md");
    if (!file)
        throw std::runtime_error("protocol/PROTOCOL.md cannot be read");
    ProtocolDocument document;
    std::string section;  // "3" and "4" tell the two messages called bye apart
    std::string table;
    std::string fence;
    bool in_fence = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("```")) {
            in_fence = !in_fence;
            fence = line.substr(3);
            if (in_fence)
                document.examples[fence].emplace_back();
            else
                fence.clear();
        } else if (in_fence) {
            document.examples[fence].back() += line + "\n";
        } else if (line.starts_with("## ")) {
            section = line.substr(3, 1);
            table = section;
        } else if (line.starts_with("### ")) {
            table = section + "/" + line.substr(4);
        } else if (line.starts_with("*") && !line.starts_with("**")) {
            table = section + "/" + line.substr(1, line.find('*', 1) - 1);
        } else if (line.starts_with("|")) {
            document.tables[table].push_back(cells_of(line));
        }
    }
    return document;
}

}  // namespace farlight

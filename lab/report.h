// What the laboratory found, as lines, as JSON and as one page.
#pragma once

#include "lab/capabilities.h"
#include "lab/case.h"

#include <nlohmann/json.hpp>

namespace farlight::lab {

struct Judged {
    Case hard_case;
    Findings findings;
    std::string failure;  ///< Why it ended without findings; empty if it did not.
    double seconds = 0;

    std::string_view verdict() const;
    bool counts_as_failure() const { return verdict() == "FAIL"; }
};

/// What became of a case without one of its guards.
struct Mutation {
    std::string guard;
    std::string case_id;
    bool noticed = false;  ///< The case failed, as it must.
    std::string how;  ///< What it measured, or how it ended.
};

struct Sheet {
    std::string device;
    std::vector<Capability> capabilities;
    std::vector<Judged> cases;
    std::vector<Mutation> mutations;
};

/// "49  mean of equal frames: drift 0 <= 1e-06, margin 100 %  ok"
std::string line_of(const Judged& judged);
std::string line_of(const Mutation& mutation);
nlohmann::json to_json(const Sheet& sheet);
std::string to_html(const Sheet& sheet);

}  // namespace farlight::lab

// Judging what was played: one verdict an expectation, and JUnit XML of them.
#pragma once

#include "client/script/play.h"

#include <string>
#include <vector>

namespace farlight::client {

struct Verdict {
    std::string expectation;
    bool ok = false;
    std::string finding;  ///< "0.031 <= 0.0123", or why it cannot be said.
};

std::vector<Verdict> judge(const Script& script, const Played& played);

/// "ok  nonfinite == 0  (0)" or "FAIL relmse(a) <= 1  (2.3)".
std::string to_line(const Verdict& verdict);

struct JudgedScript {
    std::string file;
    double seconds = 0;
    std::vector<Verdict> verdicts;
};

/// The JUnit XML that CI systems read: a suite a file, a case an expectation.
std::string junit_xml(const std::vector<JudgedScript>& scripts);

}  // namespace farlight::client

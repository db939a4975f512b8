// Whether what a pass declares and what its program uses are the same, both ways.
#pragma once

#include "server/render/pass.h"

#include <set>

namespace farlight {

class DeclarationCheck {
public:
    /// `strict`: a declared name that is not active in the program throws; else it is logged once.
    /// What is active is the driver's decision and depends on the scene (an empty one needs no
    /// random number), so tests are strict on scenes that use everything and servers are not.
    explicit DeclarationCheck(bool strict) : strict_(strict) { }

    /// Throws ShaderError naming pass and variable. `blocks` are offered to every pass.
    void operator()(
        const Pass& pass, const Program& program, const std::vector<BlockInput>& blocks);

private:
    void check_declared(const Pass& pass, const Program& program);

    bool strict_;
    std::set<std::string> warned_;
};

}  // namespace farlight

// ProgramCache: each (shader, defines) is compiled once and shared by every view.
#pragma once

#include "server/gl/program.h"

#include <map>
#include <memory>
#include <string>

namespace farlight {

class ProgramCache {
public:
    /// Compiles at first use. The reference stays valid as long as the cache. Throws ShaderError.
    const Program& get(const std::string& shader, const Defines& defines);
    std::size_t size() const { return programs_.size(); }

private:
    std::map<std::string, std::unique_ptr<Program>> programs_;
};

}  // namespace farlight

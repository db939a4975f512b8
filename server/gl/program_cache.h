// ProgramCache: each (shader, defines) is compiled once and shared by every view.
#pragma once

#include "server/gl/program.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace farlight {

class ProgramBinaries;

/// What a program is compiled from.
struct ProgramKey {
    std::string shader;
    Defines defines;

    bool operator==(const ProgramKey&) const = default;
    bool operator<(const ProgramKey& other) const
    {
        return std::tie(shader, defines) < std::tie(other.shader, other.defines);
    }
};

/// Used by one thread at a time; programs may be handed from one cache to another whose context
/// shares objects with its own.
class ProgramCache {
public:
    /// `binaries`: compiled programs of earlier runs, to be used before any compiler; none: null.
    explicit ProgramCache(const ProgramBinaries* binaries = nullptr) : binaries_(binaries) { }

    /// Compiles at first use. The reference stays valid as long as the program is in the cache.
    /// Throws ShaderError.
    const Program& get(const ProgramKey& key);
    const Program& get(const std::string& shader, const Defines& defines)
    {
        return get(ProgramKey{shader, defines});
    }
    bool has(const ProgramKey& key) const { return programs_.contains(key); }
    /// In the place of one that may be there, which is dropped.
    void adopt(const ProgramKey& key, std::unique_ptr<Program> program);
    /// Takes a program out, or nothing if it is not there.
    std::unique_ptr<Program> take(const ProgramKey& key);
    /// Forgets programs whose key `unwanted` accepts; delete_dropped() deletes them.
    template <typename Unwanted> void drop(const Unwanted& unwanted)
    {
        for (auto& [key, program] : programs_)
            if (unwanted(key))
                dropped_.push_back(std::move(program));
        std::erase_if(programs_, [](const auto& entry) { return entry.second == nullptr; });
    }
    /// Not while another context is at work that has used one of them (gl_worker.h).
    void delete_dropped() { dropped_.clear(); }
    std::size_t size() const { return programs_.size(); }

private:
    const ProgramBinaries* binaries_;
    std::map<ProgramKey, std::unique_ptr<Program>> programs_;
    std::vector<std::unique_ptr<Program>> dropped_;
};

}  // namespace farlight

// HostGuard: a place in C++ that keeps a hard case, by name, so that the laboratory can take it out
// as it takes out a shader's text (lab/guards.h). Any room of the server may include this.
#pragma once

namespace farlight {

namespace lab {
class HostGuards;
}

/// True, but for a process of the laboratory that took it out (`--without NAME`): no setting,
/// option or variable of another program reaches it. A static object beside the code that it
/// guards:
///     const HostGuard without_area("without_area");
///     if (without_area && area == 0) ...
/// It costs a load: not for what is done for every vertex, pixel or ray.
class HostGuard {
public:
    /// `name` is a literal, as the guard's row in the laboratory spells it.
    explicit HostGuard(const char* name) noexcept : name_(name), next_(first) { first = this; }
    HostGuard(const HostGuard&) = delete;
    HostGuard& operator=(const HostGuard&) = delete;

    explicit operator bool() const { return in_; }

private:
    friend class lab::HostGuards;

    const char* name_;
    const HostGuard* next_;
    mutable bool in_ = true;
    static inline const HostGuard* first = nullptr;  ///< Of all in this process.
};

}  // namespace farlight

// Latest: a one-slot mailbox between two threads. The newest value wins; nothing queues up.
#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace farlight {

template <typename T> class Latest {
public:
    /// Leaves `value` to be taken, in place of one still waiting.
    void put(T value)
    {
        const std::lock_guard lock(mutex_);
        slot_ = std::move(value);
    }

    /// Puts `value` in place of the one waiting. False: none waits, it was taken already.
    bool replace(T value)
    {
        const std::lock_guard lock(mutex_);
        if (!slot_)
            return false;
        slot_ = std::move(value);
        return true;
    }

    /// The waiting value, or nothing; the slot is empty afterwards.
    std::optional<T> take()
    {
        const std::lock_guard lock(mutex_);
        return std::exchange(slot_, std::nullopt);
    }

    bool waiting() const
    {
        const std::lock_guard lock(mutex_);
        return slot_.has_value();
    }

private:
    mutable std::mutex mutex_;
    std::optional<T> slot_;
};

}  // namespace farlight

#pragma once
/// Long work that is stopped from the keyboard ends in order, so that no half-written file stays behind.

namespace blush::tool {

/// While one lives, SIGINT and SIGTERM do not end the program but make interrupted() true. One at a time.
class Interruptible {
public:
    Interruptible();
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

private:
    void (*old_interrupt_)(int);
    void (*old_terminate_)(int);
};

bool interrupted();

}  // namespace blush::tool

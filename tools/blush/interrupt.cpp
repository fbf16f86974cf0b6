#include "tools/blush/interrupt.h"

#include <csignal>

namespace blush::tool {
namespace {

volatile std::sig_atomic_t stop = 0;
void ask_to_stop(int) { stop = 1; }

}  // namespace

Interruptible::Interruptible()
    : old_interrupt_(std::signal(SIGINT, ask_to_stop)), old_terminate_(std::signal(SIGTERM, ask_to_stop)) {}

Interruptible::~Interruptible() {
    std::signal(SIGINT, old_interrupt_);
    std::signal(SIGTERM, old_terminate_);
}

bool interrupted() { return stop != 0; }

}  // namespace blush::tool

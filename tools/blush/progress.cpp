#include "tools/blush/progress.h"

#include <unistd.h>

#include <iostream>

namespace blush::tool {

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (terminal_ && done_ != 0) std::cerr << "\n";
}

void Progress::step() {
    ++done_;
    if (terminal_) {
        constexpr std::size_t width = 40;
        const std::size_t filled = done_ * width / total_;
        std::cerr << "\r" << what_ << " [" << std::string(filled, '#') << std::string(width - filled, '.') << "] "
                  << done_ << "/" << total_ << std::flush;
    } else if (done_ * 10 / total_ != (done_ - 1) * 10 / total_) {
        std::cerr << what_ << ": " << done_ << " of " << total_ << "\n";
    }
}

}  // namespace blush::tool

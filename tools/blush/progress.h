#pragma once
/// Progress of long work on standard error: a bar on a terminal, a plain line every tenth when piped.

#include <cstddef>
#include <string>

namespace blush::tool {

class Progress {
public:
    Progress(std::string what, std::size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void step();

private:
    std::string what_;
    std::size_t total_, done_ = 0;
    bool terminal_;
};

}  // namespace blush::tool

#pragma once
/// How long each pass takes on the GPU's clock.

#include <vector>

#include "runtime/gl/object.h"

namespace blush::gl {

class Timers {
public:
    /// Starts a frame; what was measured before is forgotten.
    void clear() { used_ = 0; }
    /// One at a time. Returns the timer's index.
    std::size_t start() {
        if (used_ == queries_.size()) queries_.push_back(make_query(GL_TIME_ELAPSED));
        glBeginQuery(GL_TIME_ELAPSED, queries_[used_].name());
        return used_++;
    }
    void stop() { glEndQuery(GL_TIME_ELAPSED); }
    /// Waits for the GPU.
    double milliseconds(std::size_t timer) const {
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(queries_[timer].name(), GL_QUERY_RESULT, &nanoseconds);
        return static_cast<double>(nanoseconds) * 1e-6;
    }

private:
    std::vector<Query> queries_;
    std::size_t used_ = 0;
};

}  // namespace blush::gl

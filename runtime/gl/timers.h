#pragma once
/// How long each pass takes on the GPU's clock.

#include <vector>

#include "runtime/gl/object.h"

namespace blush::gl {

/// Timestamps rather than GL_TIME_ELAPSED, of which only one may be active: the host may have its own.
class Timers {
public:
    /// Starts a frame; what was measured before is forgotten.
    void clear() { used_ = 0; }
    void start() { stamp(); }
    void stop() { stamp(); }
    /// Time between the n-th start() and the stop() after it. Waits for the GPU.
    double milliseconds(std::size_t n) const {
        GLuint64 from_ns = 0, to_ns = 0;
        glGetQueryObjectui64v(queries_[2 * n].name(), GL_QUERY_RESULT, &from_ns);
        glGetQueryObjectui64v(queries_[2 * n + 1].name(), GL_QUERY_RESULT, &to_ns);
        return static_cast<double>(to_ns - from_ns) * 1e-6;
    }

private:
    void stamp() {
        if (used_ == queries_.size()) queries_.push_back(make_query(GL_TIMESTAMP));
        glQueryCounter(queries_[used_++].name(), GL_TIMESTAMP);
    }
    std::vector<Query> queries_;
    std::size_t used_ = 0;
};

}  // namespace blush::gl

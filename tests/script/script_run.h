#pragma once
/// Scripts run on a small rig, for tests.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rig/controls/rig.h"
#include "rig/face.h"
#include "runtime/script/script.h"

namespace blush::test {

inline Face face_with(const std::vector<std::string>& targets) {
    Face face;
    face.path = "face.glb";
    for (const std::string& name : targets) {
        face.targets.emplace_back();
        face.targets.back().name = name;
    }
    return face;
}

/// A script on a face of the controls "joy", "sadness", "anger", "blush", "jawOpen" and the angles.
class ScriptRun {
public:
    explicit ScriptRun(const std::string& text, ScriptOptions options = {})
        : rig(face_with({"joy", "sadness", "anger", "blush", "jawOpen"})), below(rig.control_names().size(), 0) {
        options.print = [this](std::string_view line) { printed.emplace_back(line); };
        Result<Script> created = Script::create(text, "folder/test.lua", rig, std::move(options));
        if (!created) {
            error = created.error().message;
            return;
        }
        script = std::make_unique<Script>(*std::move(created));
    }
    /// Goes to a time in steps of `step_seconds`; stops at the first error.
    ScriptRun& to(double seconds, double step_seconds = 1.0 / 64) {
        while (script && error.empty() && (!started_ || script->now_seconds() < seconds - 1e-9)) {
            const double step = started_ ? std::min(step_seconds, seconds - script->now_seconds()) : 0;
            started_ = true;
            if (Status stepped = script->step(step, below); !stepped) error = stepped.error().message;
        }
        return *this;
    }
    std::vector<float> controls() {
        std::vector<float> values = below;
        script->apply(values);
        return values;
    }
    float value(const std::string& name) { return controls()[static_cast<std::size_t>(*rig.find(name))]; }

    Rig rig;
    std::vector<float> below;
    std::unique_ptr<Script> script;
    std::string error;
    std::vector<std::string> printed;

private:
    bool started_ = false;
};

/// The error of a script within its first second; "" where it has none.
inline std::string error_of(const std::string& text, ScriptOptions options = {}) {
    return ScriptRun(text, std::move(options)).to(1).error;
}

}  // namespace blush::test

#pragma once
/// A face on the device with a share of its targets active: what studies of the deformation run on.

#include <memory>
#include <vector>

#include "rig/deform/deform_exact.h"
#include "runtime/frame/character_state.h"
#include "runtime/measure/portrait.h"
#include "runtime/measure/study.h"

namespace blush {

struct StudyScene {
    Portrait character;
    ExactSurface exact;
    std::vector<ActiveTarget> active;

    StreamOut& stream_out() { return character.state().stream_out; }
    Scene::Surface read() { return character.read_deformed(); }
};

/// The first `active_count` targets at weights that differ (0.3 to 0.9). Nothing when the face does not fit the device.
std::shared_ptr<StudyScene> make_study_scene(const Device& device, const Face& face, std::size_t active_count);

/// Numbers of active targets worth measuring on a face: one, about a dozen (a usual frame), all of them.
std::vector<std::size_t> study_counts(const Face& face, bool quick);

}  // namespace blush

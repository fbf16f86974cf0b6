#pragma once
/// Makes the programs that frames can come to need, ahead of them: draws the scene's characters in the situations that
/// predicates tell apart, through the path that every frame takes, into a picture that nobody sees.

#include "runtime/frame/frame_state.h"
#include "runtime/scene.h"

namespace blush {

/// One slice. `view`: whose settings count, and where the progress is kept.
WarmUpProgress warm_up(FrameState& view, SceneState& scene, const ViewFrame& like, std::uint32_t most_programs);

}  // namespace blush

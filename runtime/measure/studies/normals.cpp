/// Normals by their sources, against those recomputed on the deformed mesh in double precision.

#include <algorithm>

#include "runtime/measure/errors.h"
#include "runtime/measure/studies.h"
#include "runtime/measure/study_scene.h"

namespace blush {
namespace {

Study study_of(const Device& device, const Face& face, std::size_t active) {
    std::shared_ptr<StudyScene> scene = make_study_scene(device, face, active);
    Study study{std::to_string(active) + " of " + std::to_string(face.targets.size()) + " targets active, " +
                    std::to_string(face.positions.size()) + " vertices",
                "normals recomputed on the deformed mesh in double precision (rig/deform/deform_exact.h)",
                "degrees",
                {},
                scene};
    if (!scene) return study;
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        const std::string_view choice = method == NormalMethod::authored ? "authored" : "recomputed";
        Variant variant;
        variant.label = "normals.source=" + std::string(choice);
        variant.is_default = method == NormalMethod::authored;
        const bool turns =
            method == NormalMethod::recomputed || std::ranges::any_of(face.primitives, [](const Primitive& primitive) {
                return primitive.normal_source == NormalSource::recomputed;
            });
        variant.work = turns ? "deformation, and the fan of every moved vertex" : "deformation with normal deltas";
        variant.run = [scene, method, turns] {
            scene->stream_out().add_targets_sparse(method);
            if (turns) scene->stream_out().turn_normals(method);
            glFinish();
        };
        variant.error = [scene, choice] {
            const Status chosen = scene->character.set("normals.source", choice);
            return chosen ? angle_error(scene->read().normals, scene->exact.normals) : Variant::Error{};
        };
        study.variants.push_back(std::move(variant));
    }
    return study;
}

}  // namespace

std::vector<Study> studies::normals(const Device& device, const Face& face, double /*millimetres_a_unit*/, bool quick) {
    std::vector<Study> result;
    for (const std::size_t count : study_counts(face, quick)) result.push_back(study_of(device, face, count));
    return result;
}

}  // namespace blush

/// blush lint of a script.

#include "runtime/script/lint_script.h"
#include "rig/names.h"
#include "runtime/files/face_file.h"
#include "runtime/files/rig_description_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/lint.h"
#include "tools/blush/performing.h"

namespace blush::tool {
namespace {

Face face_with_arkit() {
    Face face;
    face.path = "a face with ARKit's shapes";
    for (const std::string_view name : arkit_names) {
        face.targets.emplace_back();
        face.targets.back().name = name;
    }
    return face;
}

}  // namespace

Result<Findings> lint_script_file(const std::filesystem::path& file, const std::string& face_name) {
    Face face = face_with_arkit();
    if (!face_name.empty()) {
        Result<Face> loaded = load_face(face_path(face_name));
        if (!loaded) return loaded.error();
        face = *std::move(loaded);
    }
    const Result<RigDescription> description = find_rig_description(face);
    if (!description) return description.error();
    const Rig rig(face, *description);
    const Result<std::vector<ScriptFinding>> found = lint_script(file, rig, performances_for_script(face, file));
    if (!found) return found.error();
    Findings findings;
    for (const ScriptFinding& finding : *found) {
        findings.push_back(
            {finding.line > 0 ? "line " + std::to_string(finding.line) : "the script", finding.sentence});
    }
    return findings;
}

}  // namespace blush::tool

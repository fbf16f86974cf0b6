/// blush lint: names everything odd about a file and changes nothing.

#include "tools/blush/lint.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "tools/blush/assets.h"
#include "tools/blush/commands.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The first entry whose ending the file has.
struct KnownKind {
    std::string_view ending;
    Linter linter;
};
constexpr KnownKind known_kinds[] = {
    {".rig.json", lint_rig}, {".glb", lint_face}, {".gltf", lint_face}, {".obj", lint_face}, {".lua", lint_script_file},
};

Linter linter_of(const fs::path& file) {
    const std::string name = file.filename().string();
    for (const KnownKind& kind : known_kinds) {
        if (name.ends_with(kind.ending)) return kind.linter;
    }
    return nullptr;
}

int lint(const std::string& name, const std::string& face, bool as_json) {
    const fs::path file = face_path(name);
    const Linter linter = linter_of(file);
    if (linter == nullptr) {
        std::string endings;
        for (const KnownKind& kind : known_kinds) endings += (endings.empty() ? "" : ", ") + std::string(kind.ending);
        return fail({file.string() + ": lint does not know this kind of file (it knows " + endings + ")"});
    }
    const Result<Findings> findings = linter(file, face);
    if (!findings) return fail(findings.error());
    if (as_json) {
        Json json = {{"file", file.string()}, {"findings", Json::array()}};
        for (const Finding& finding : *findings) {
            json["findings"].push_back({{"place", finding.place}, {"finding", finding.sentence}});
        }
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
        return 0;
    }
    if (findings->empty()) std::cout << file.string() << ": nothing odd\n";
    for (const Finding& finding : *findings) {
        std::cout << file.string() << ": " << finding.place << ": " << finding.sentence << "\n";
    }
    return 0;
}

}  // namespace

void add_lint(Command& program) {
    struct Options {
        std::string file, face;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("lint", "Name everything odd about a file, and change nothing");
    command
        .option("FILE", &options->file, "A face (.glb, .gltf, .obj, \"default\"), a rig (.rig.json) or a script (.lua)")
        .required();
    command.option("--face", &options->face,
                   "The face that a rig or a script is for; without it, the one beside a rig, and one with all of "
                   "ARKit's shapes for a script");
    command.flag("--json", options->json, "Print JSON");
    command.runs([options] { return lint(options->file, options->face, options->json); });
}

}  // namespace blush::tool

#include "tools/make_face/face_command.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "runtime/files/face_appearance.h"
#include "tools/make_face/head_mesh.h"
#include "tools/make_face/write_maps.h"

namespace blush::make_face {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> preset_names(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return all;
}

void print_list(const fs::path& preset_folder) {
    std::printf("presets: %s\n\n", joined(preset_names(preset_folder)).c_str());
    for (const Parameter& p : parameters()) {
        std::printf("%-18s %g to %g %s: %s", std::string(p.name).c_str(), p.least, p.most, std::string(p.unit).c_str(),
                    std::string(p.measure).c_str());
        if (p.women != 0 || p.men != 0) std::printf("; women %g, men %g, sd %g", p.women, p.men, p.standard_deviation);
        std::printf(" (%s)\n", std::string(p.source).c_str());
    }
}

}  // namespace

void FaceCommand::add_to(Command& command) {
    command.option("-o,--output", &output, "The .glb file to write");
    command.option("--preset", &preset, "A shipped person by name, or a .json file (docs/default_face.md)");
    command.option("--set", &sets, "A parameter and its value, such as jaw_width=+1; may be given several times")
        .split_at_commas();
    command.option("--vertices", &vertices, "Vertices of the skin, roughly")
        .range(double{least_vertices}, double{most_vertices})
        .shows_default();
    command.option("--texture-size", &texture_side, "Texels of a side of the skin's maps")
        .range(64, 8'192)
        .shows_default();
    command.flag("--maps", maps, "Also write melanin, hemoglobin and what expressions do to it, beside the file");
    command.flag("--list", list, "Print presets and parameters with their ranges, and write nothing");
}

Result<Person> FaceCommand::person(const fs::path& preset_folder) const {
    Person person;
    if (!preset.empty()) {
        const bool named = preset.find_first_of("./") == std::string::npos;
        const fs::path path = named ? preset_folder / (preset + ".json") : fs::path(preset);
        std::ifstream file(path, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        if (!file) {
            if (named) return Error{"--preset " + preset + ": there are " + joined(preset_names(preset_folder))};
            return Error{path.string() + ": cannot be read"};
        }
        Result<Person> read = read_person(text, path.string());
        if (!read) return read.error();
        person = *std::move(read);
    }
    for (const std::string& assignment : sets)
        if (Status s = set_parameter(person, assignment); !s) return s.error();
    return person;
}

Status FaceCommand::run(const fs::path& preset_folder) const {
    if (list) {
        print_list(preset_folder);
        return Done{};
    }
    if (output.empty()) return Error{"--output is required"};
    const Result<Person> who = person(preset_folder);
    if (!who) return who.error();
    // An unwritable path is found out before the seconds of work.
    if (Status s = check_writable(output); !s) return s;
    const FaceParts face = build_face(vertices, *who, texture_side);
    if (Status s = make_face::write_file(output, glb_bytes(face)); !s || !maps) return s;
    return write_maps(appearance_folder(output), *face.pigments, output, preset_folder.parent_path() / "hemoglobin");
}

}  // namespace blush::make_face

// Imported heads: small ones made here, whose numbers can be checked by hand, and the published ones, held to a plain
// reading of their text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "runtime/files/bad_file.h"
#include "runtime/files/face_file.h"
#include "runtime/files/gltf/glb_writer.h"
#include "runtime/files/import/file_tree.h"
#include "runtime/files/import/import_head.h"
#include "tests/gltf_builder.h"
#include "tests/shared_data.h"

namespace blush {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Files = std::vector<std::pair<std::string, std::string>>;

void write(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

/// An uncompressed tar archive (POSIX ustar): 512 bytes of header and the padded content of each file.
std::string tar_of(const Files& files) {
    std::string tar;
    for (const auto& [name, content] : files) {
        std::string header(512, '\0');
        header.replace(0, name.size(), name);
        header.replace(100, 7, "0000644");
        char size[12];
        std::snprintf(size, sizeof size, "%011zo", content.size());
        header.replace(124, 11, size);
        header.replace(148, 8, "        ");
        header[156] = '0';
        header.replace(257, 6, std::string("ustar\0", 6));
        header.replace(263, 2, "00");
        unsigned sum = 0;
        for (const char c : header) sum += static_cast<unsigned char>(c);
        char checksum[8];
        std::snprintf(checksum, sizeof checksum, "%06o", sum);
        header.replace(148, 7, std::string(checksum, 7));
        tar += header + content + std::string((512 - content.size() % 512) % 512, '\0');
    }
    return tar + std::string(1024, '\0');
}

// --- Folders and archives
// ---------------------------------------------------------------------------------------------

std::map<std::string, std::string> read_tree(const std::filesystem::path& path, const load::TreeLimits& limits = {}) {
    std::map<std::string, std::string> found;
    load::each_file(
        path, [](std::string_view name) { return name.ends_with(".txt"); },
        [&](const std::string& name, const load::Bytes& bytes) {
            found[name] = {bytes.begin(), bytes.end()};
        },
        limits);
    return found;
}

std::string refusal(const std::filesystem::path& path, const load::TreeLimits& limits = {}) {
    try {
        read_tree(path, limits);
    } catch (const load::BadFile& bad) {
        return bad.place + "|" + bad.reason;
    }
    return "accepted";
}

const Files some_files = {{"a.txt", "one"}, {"deep/er/b.txt", "two"}, {"c.bin", "three"}};

TEST(FileTree, AFolderAndItsArchiveHoldTheSame) {
    const TemporaryFolder folder;
    for (const auto& [name, content] : some_files) write(folder / "tree" / name, content);
    write(folder / "tree.tar", tar_of(some_files));
    const std::map<std::string, std::string> expected = {{"a.txt", "one"}, {"deep/er/b.txt", "two"}};
    EXPECT_EQ(read_tree(folder / "tree"), expected);
    EXPECT_EQ(read_tree(folder / "tree.tar"), expected);
}

TEST(FileTree, LinksAreNotFollowed) {
    const TemporaryFolder folder;
    write(folder / "secret.txt", "secret");
    write(folder / "tree/a.txt", "one");
    std::filesystem::create_symlink(folder / "secret.txt", folder / "tree/link.txt");
    EXPECT_EQ(read_tree(folder / "tree").size(), 1U);
}

TEST(FileTree, NamesThatLeadOutAreRefused) {
    const TemporaryFolder folder;
    write(folder / "up.tar", tar_of({{"a/../../x.txt", "x"}}));
    EXPECT_EQ(refusal(folder / "up.tar"), "a/../../x.txt|the name leads out of the archive");
    write(folder / "root.tar", tar_of({{"/etc/x.txt", "x"}}));
    EXPECT_EQ(refusal(folder / "root.tar"), "/etc/x.txt|the name leads out of the archive");
}

TEST(FileTree, WhatIsTooMuchIsRefused) {
    const TemporaryFolder folder;
    const std::string large(4000, 'x');
    write(folder / "tree/a.txt", large);
    write(folder / "tree/b.txt", large);
    write(folder / "tree.tar", tar_of({{"a.txt", large}, {"b.txt", large}}));
    for (const char* name : {"tree", "tree.tar"}) {
        EXPECT_THAT(refusal(folder / name, {.file_bytes = 3999}), HasSubstr("a.txt|")) << name;
        EXPECT_THAT(refusal(folder / name, {.all_bytes = 7999}), HasSubstr("b.txt|")) << name;
        EXPECT_EQ(refusal(folder / name, {.entries = 1}), "|it has more than 1 entries") << name;
        EXPECT_EQ(refusal(folder / name, {.file_bytes = 4000, .all_bytes = 8000, .entries = 2}), "accepted") << name;
    }
}

TEST(FileTree, EveryTruncationOfAnArchiveIsRefusedOrHoldsOnlyWholeFiles) {
    const TemporaryFolder folder;
    const std::string tar = tar_of(some_files);
    const auto whole = [](const std::map<std::string, std::string>& files) {
        for (const auto& [name, content] : files) {
            if (content != (name == "a.txt" ? "one" : "two")) return false;
        }
        return true;
    };
    for (std::size_t length = 0; length < tar.size(); length += 131) {
        write(folder / "cut.tar", tar.substr(0, length));
        try {
            EXPECT_TRUE(whole(read_tree(folder / "cut.tar"))) << length;
        } catch (const load::BadFile& bad) {
            EXPECT_FALSE(bad.reason.empty()) << length;
        }
    }
}

// --- The writer
// -------------------------------------------------------------------------------------------------------

TEST(GlbWriter, WhatIsReadIsWrittenToTheBit) {
    const TemporaryFolder folder;
    test::GlbBuilder glb;
    glb.grid(6, 4)
        .target("a", {3, 4}, {{0, -1, 0.25F}, {0, 1e-30F, 0}}, {{0, 0.5F, 0}, {0, 0, 0}})
        .target("idle", {}, {}, {})
        .target("b", {0, 34}, {{0.1F, 0.2F, 0.3F}, {-1, 0, 0}}, {{0, 0, 0}, {0, 0.25F, 0}});
    glb.json["nodes"] = {{{"name", "root"}, {"scale", {0.01, 0.01, 0.01}}, {"children", {1}}},
                         {{"name", "skin"}, {"mesh", 0}, {"translation", {1, 2, 3}}}};
    glb.json["materials"] = {
        {{"name", "clear"},
         {"alphaMode", "BLEND"},
         {"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"roughnessFactor", 0.3}, {"metallicFactor", 0.0}}}}};
    glb.primitive()["material"] = 0;
    glb.write(folder / "one.glb");
    const Result<Face> one = load_face(folder / "one.glb");
    ASSERT_TRUE(one) << one.error().message;
    const Result<std::string> bytes = load::glb_bytes(*one, {}, "test");
    ASSERT_TRUE(bytes) << bytes.error().message;
    write(folder / "two.glb", *bytes);
    const Result<Face> two = load_face(folder / "two.glb");
    ASSERT_TRUE(two) << two.error().message;
    EXPECT_EQ(one->positions, two->positions);
    EXPECT_EQ(one->normals, two->normals);
    EXPECT_EQ(one->uv0, two->uv0);
    EXPECT_EQ(one->indices, two->indices);
    ASSERT_EQ(two->targets.size(), 3U);
    for (std::size_t t = 0; t < 3; ++t) {
        EXPECT_EQ(one->targets[t].name, two->targets[t].name);
        EXPECT_EQ(one->targets[t].vertices, two->targets[t].vertices);
        EXPECT_EQ(one->targets[t].position_deltas, two->targets[t].position_deltas);
    }
    EXPECT_EQ(one->targets[0].normal_deltas, two->targets[0].normal_deltas);
    EXPECT_EQ(two->materials[0].base_color_linear, one->materials[0].base_color_linear);
    EXPECT_EQ(two->materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_TRUE(two->materials[0].double_sided);
    ASSERT_EQ(two->nodes.size(), 2U);
    EXPECT_EQ(two->nodes[0].rest.scale, glm::vec3(0.01F));
    EXPECT_EQ(two->nodes[1].rest.translation, glm::vec3(1, 2, 3));
    EXPECT_EQ(two->nodes[1].parent, 0);
}

// --- Small heads
// ------------------------------------------------------------------------------------------------------

/// A quad and a triangle; the second texture coordinate of vertex 3 makes a seam.
std::string small_obj(const std::string& second_vertex = "1 0 0.5", const std::string& last_face = "f 2/5 5/6 3/3") {
    return "# a comment\nmtllib x.mtl\nv 0 0 0.5\nv " + second_vertex + "\nv 1 1 0.5\nv 0 1 0.5\nv 2 0.5 0.123456\n" +
           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0\nvt 0.5 0.5\nusemtl M_Face\nf 1/1 2/2 3/3 4/4\n" +
           "usemtl M_Teeth\n" + last_face + "\n";
}

struct SmallIct {
    TemporaryFolder folder;
    SmallIct() {
        write(folder / "FaceXModel/generic_neutral_mesh.obj", small_obj());
        write(folder / "FaceXModel/eyeBlink_L.obj", small_obj("1 -0.25 0.5"));
        write(folder / "FaceXModel/PupilDilate_R.obj", small_obj());
        write(folder / "FaceXModel/identity000.obj", "not read");
    }
    std::string refusal() const {
        const Result<ImportedHead> head = import_ict(folder / "");
        return head ? "accepted" : head.error().message.substr((folder / "").string().size());
    }
};

Result<Face> load_imported(const Result<ImportedHead>& head, const TemporaryFolder& folder) {
    if (!head) return head.error();
    write(folder / "head.glb", head->glb);
    return load_face(folder / "head.glb");
}

TEST(ImportIct, ASmallHeadComesOutAsItsFilesSay) {
    const SmallIct small;
    const Result<ImportedHead> head = import_ict(small.folder / "");
    ASSERT_TRUE(head) << head.error().message;
    EXPECT_THAT(head->notes, ElementsAre("1 identity shapes are left out: the head is the neutral one"));
    const Result<Face> face = load_imported(head, small.folder);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_THAT(face->notes, IsEmpty());
    ASSERT_EQ(face->positions.size(), 7U);  // 4 of the quad, 3 of the triangle in another material
    EXPECT_EQ(face->indices.size(), 9U);
    EXPECT_EQ(face->positions[6], glm::vec3(2, 0.5F, 0.123456F));
    EXPECT_EQ(face->uv0[4], glm::vec2(0.5F, 1));  // vertex 2 in the triangle; v grows downward
    ASSERT_EQ(face->targets.size(), 2U);
    EXPECT_EQ(face->targets[0].name, "pupilDilateRight");
    EXPECT_THAT(face->targets[0].vertices, IsEmpty());
    EXPECT_EQ(face->targets[1].name, "eyeBlinkLeft");
    const auto& blink = face->targets[1];
    const auto moved = std::ranges::find(blink.vertices, 1U) - blink.vertices.begin();
    EXPECT_EQ(blink.position_deltas[static_cast<std::size_t>(moved)], glm::vec3(0, -0.25F, 0));
    EXPECT_EQ(face->nodes[0].rest.scale, glm::vec3(0.01F));
    EXPECT_EQ(face->materials[static_cast<std::size_t>(face->primitives[0].material)].name, "skin");
    EXPECT_EQ(face->materials[static_cast<std::size_t>(face->primitives[1].material)].name, "teeth");
}

TEST(ImportIct, AnArchiveGivesTheSameBytesInAnyOrder) {
    const SmallIct small;
    const TemporaryFolder folder;
    write(folder / "ict.tar", tar_of({{"x/eyeBlink_L.obj", small_obj("1 -0.25 0.5")},
                                      {"x/generic_neutral_mesh.obj", small_obj()},
                                      {"x/PupilDilate_R.obj", small_obj()}}));
    const Result<ImportedHead> from_folder = import_ict(small.folder / ""),
                               from_archive = import_ict(folder / "ict.tar");
    ASSERT_TRUE(from_folder && from_archive);
    EXPECT_TRUE(from_folder->glb == from_archive->glb);
}

TEST(ImportIct, WhatIsWrongIsNamed) {
    {
        const SmallIct small;
        std::filesystem::remove(small.folder / "FaceXModel/generic_neutral_mesh.obj");
        EXPECT_EQ(small.refusal(), ": there is no generic_neutral_mesh.obj in it, the neutral head of ICT-FaceKit");
    }
    const auto with = [](const std::string& name, const std::string& text) {
        const SmallIct small;
        write(small.folder / "FaceXModel" / name, text);
        return small.refusal();
    };
    EXPECT_EQ(with("jawOpen.obj", small_obj("1 0 0.5\nv 3 3 3")),
              ": jawOpen.obj: it has 6 vertices, the neutral head has 5");
    EXPECT_EQ(with("jawOpen.obj", small_obj("1 0 0.5", "f 5/6 2/5 3/3")),
              ": jawOpen.obj: its faces are not those of the neutral head");
    EXPECT_EQ(with("jawOpen.obj", small_obj("1 zero 0.5")),
              ": FaceXModel/jawOpen.obj:4: \"zero\" is not a finite number");
    EXPECT_EQ(with("jawOpen.obj", small_obj("1 1e39 0.5")),
              ": FaceXModel/jawOpen.obj:4: \"1e39\" is not a finite number");
    EXPECT_EQ(with("jawOpen.obj", small_obj("1 0")), ": FaceXModel/jawOpen.obj:4: \"\" is not a finite number");
    EXPECT_EQ(with("generic_neutral_mesh.obj", small_obj("1 0 0.5", "f 2/5 6/6 3/3")),
              ": FaceXModel/generic_neutral_mesh.obj:17: vertex 6 does not exist, there are 5");
    EXPECT_EQ(with("generic_neutral_mesh.obj", small_obj("1 0 0.5", "f 2/5 5/7 3/3")),
              ": FaceXModel/generic_neutral_mesh.obj:17: texture coordinate 7 does not exist, there are 6");
    EXPECT_EQ(with("generic_neutral_mesh.obj", small_obj("1 0 0.5", "f 2/5 5/6")),
              ": FaceXModel/generic_neutral_mesh.obj:17: a face has fewer than three corners");
    EXPECT_EQ(with("deeper/eyeBlink_L.obj", small_obj()), ": FaceXModel/eyeBlink_L.obj: the expression is in it twice");
}

TEST(ImportIct, WhatIsNoArchiveIsNamed) {
    const TemporaryFolder folder;
    EXPECT_EQ(import_ict(folder / "nothing").error().message,
              (folder / "nothing").string() + ": there is no such file or folder");
    write(folder / "text.tar.xz", "this is no archive");
    EXPECT_THAT(import_ict(folder / "text.tar.xz").error().message, HasSubstr("text.tar.xz: "));
}

/// A cube of MakeHuman's kind around a joint, as the group `name`.
std::string joint_group(const std::string& name, std::size_t first) {
    const auto corner = [&](std::size_t i) { return " " + std::to_string(first + i); };
    return "g " + name + "\nf" + corner(0) + corner(1) + corner(2) + corner(3) + "\n";
}

struct SmallMakeHuman {
    TemporaryFolder folder;
    SmallMakeHuman() {
        // A body of two quads, the upper of which belongs to the head; the joints at heights 0 and 1.
        write(folder / "base.obj",
              "v -0.5 0 0\nv 0.5 0 0\nv 0.5 1 0\nv -0.5 1 0\nv -0.5 -1 0\nv 0.5 -1 0\n"
              "v -0.1 0 0\nv 0.1 0 0\nv 0.1 0 0\nv -0.1 0 0\nv -0.1 1 0\nv 0.1 1 0\nv 0.1 1 0\nv -0.1 1 0\n"
              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng body\nf 1/1 2/2 3/3 4/4\nf 5/1 6/2 2/3 1/4\n" +
                  joint_group("joint-neck", 7) + joint_group("joint-head", 11));
        write(folder / "pack/targets/faceunits/jawOpen.target", "# a comment\n3 0 -.25 .125\n10 0 1 0\n");
        write(folder / "pack/targets/visemes/viseme_aa.target", "2 .5 0 0\n");
        write(folder / "tall.target", "3 0 2 0\n");
        // One vertex at a vertex of the base mesh, one between three with an offset that grows with x of 0 to 1.
        write(folder / "parts/teeth_base/teeth_base.obj", "v 9 9 9\nv 9 9 9\nv 9 9 9\nvt 0 0\nf 1/1 2/1 3/1\n");
        write(folder / "parts/teeth_base/teeth_base.mhclo",
              "# clothes\nname x\nx_scale 0 1 0.5\nverts 0\n2\n3\n0 1 3 0.5 0.25 0.25 0.125 0 1\n\ndelete_verts\n1 - "
              "5\n");
    }
    Result<ImportedHead> import(const MakeHumanOptions& options = {}) const {
        return import_makehuman(folder / "", options);
    }
    std::string refusal(const MakeHumanOptions& options = {}) const {
        const Result<ImportedHead> head = import(options);
        return head ? "accepted" : head.error().message.substr((folder / "").string().size());
    }
};

TEST(ImportMakeHuman, ASmallHeadComesOutAsItsFilesSay) {
    const SmallMakeHuman small;
    const Result<ImportedHead> head = small.import();
    const Result<Face> face = load_imported(head, small.folder);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_THAT(head->notes, testing::Contains("there is no tongue01.obj: that part is left out"));
    ASSERT_EQ(face->positions.size(), 7U);  // the upper quad and three vertices of the teeth
    EXPECT_EQ(face->positions[3], glm::vec3(-0.5F, 1, 0));
    EXPECT_EQ(face->positions[5], glm::vec3(-0.5F, 1, 0));
    // 0.5 (-0.5, 0, 0) + 0.25 (0.5, 0, 0) + 0.25 (-0.5, 1, 0), and x offset 0.125 times 1 / 0.5.
    EXPECT_EQ(face->positions[6], glm::vec3(0, 0.25F, 1));
    ASSERT_EQ(face->targets.size(), 2U);
    const Target& jaw = face->targets[0];
    EXPECT_EQ(jaw.name, "jawOpen");
    const auto delta = [&](std::uint32_t vertex) {
        const auto found = std::ranges::find(jaw.vertices, vertex);
        return found == jaw.vertices.end()
                   ? glm::vec3(0)
                   : jaw.position_deltas[static_cast<std::size_t>(found - jaw.vertices.begin())];
    };
    EXPECT_EQ(delta(3), glm::vec3(0, -0.25F, 0.125F));
    EXPECT_EQ(delta(5), glm::vec3(0, -0.25F, 0.125F));
    EXPECT_EQ(delta(6), glm::vec3(0, -0.0625F, 0.03125F));
    EXPECT_EQ(delta(0), glm::vec3(0));
    EXPECT_EQ(face->nodes[0].rest.scale, glm::vec3(0.1F));
}

TEST(ImportMakeHuman, AShapeChangesThePersonAndNotTheCut) {
    const SmallMakeHuman small;
    const Result<Face> face = load_imported(small.import({{"tall=0.5"}}), small.folder);
    ASSERT_TRUE(face) << face.error().message;
    ASSERT_EQ(face->positions.size(), 7U);
    EXPECT_EQ(face->positions[3], glm::vec3(-0.5F, 2, 0));
    EXPECT_EQ(small.refusal({{"short"}}), ": there is no short.target in it");
    EXPECT_EQ(small.refusal({{"tall=x"}}), ": the weight of the shape \"tall=x\" is not a number from -10 to 10");
    EXPECT_EQ(small.refusal({{"tall=nan"}}), ": the weight of the shape \"tall=nan\" is not a number from -10 to 10");
}

TEST(ImportMakeHuman, WhatIsWrongIsNamed) {
    const auto with = [](const std::string& name, const std::string& text) {
        const SmallMakeHuman small;
        write(small.folder / name, text);
        return small.refusal();
    };
    const std::string target = "pack/targets/faceunits/jawOpen.target", part = "parts/teeth_base/teeth_base.mhclo";
    EXPECT_EQ(with(target, "# x\n3 0 0 0\n14 0 0 0\n"), ": " + target + ":3: vertex 14 does not exist, there are 14");
    EXPECT_EQ(with(target, "3 0 0\n"), ": " + target + ":1: \"\" is not a finite number");
    EXPECT_EQ(with(target, "-1 0 0 0\n"), ": " + target + ":1: \"-1\" is not an index");
    EXPECT_EQ(with(part, "verts 0\n2\n"),
              ": " + part + ": it places 1 vertices, parts/teeth_base/teeth_base.obj has 3");
    EXPECT_EQ(with(part, "x_scale 0 1 0\n"), ": " + part + ":1: the distance of a scale is not above zero");
    EXPECT_EQ(with(part, "verts 0\n99\n"), ": " + part + ":2: vertex 99 does not exist, there are 14");
    EXPECT_EQ(with("base.obj", "v 0 0 0\nf 1 1 1\n"),
              ": base.obj: there is no group joint-neck, by which the head is cut");
    EXPECT_EQ(with("more/faceunits/jawOpen.target", ""), ": " + target + ": the target is in it twice");
    const SmallMakeHuman small;
    std::filesystem::remove(small.folder / "base.obj");
    EXPECT_EQ(small.refusal(), ": there is no base.obj in it, MakeHuman's base mesh");
}

// --- The published heads
// ----------------------------------------------------------------------------------------------

struct PlainObj {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec2> uv;
    std::set<std::array<int, 2>> corners;
    std::size_t triangles = 0;
};

/// A second, plain reader: the C library's strtod, no checks.
PlainObj plain_obj(const std::string& text) {
    PlainObj obj;
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line)) {
        const char* at = line.c_str() + 2;
        char* end = nullptr;
        const auto next = [&] {
            const double value = std::strtod(at, &end);
            at = end;
            return value;
        };
        if (line.starts_with("v ")) {
            const double x = next(), y = next();
            obj.positions.emplace_back(x, y, next());
        } else if (line.starts_with("vt ")) {
            ++at;
            const double u = next();
            obj.uv.emplace_back(u, 1 - next());
        } else if (line.starts_with("f ")) {
            std::istringstream words(line.substr(2));
            std::size_t count = 0;
            for (std::string word; words >> word; ++count)
                obj.corners.insert({std::stoi(word) - 1, std::stoi(word.substr(word.find('/') + 1)) - 1});
            obj.triangles += count - 2;
        }
    }
    return obj;
}

/// Vertices of the OBJ file by place and texture coordinate, as a face vertex carries them.
using Signature = std::array<float, 5>;
Signature signature(glm::vec3 p, glm::vec2 uv) { return {p.x, p.y, p.z, uv.x, uv.y}; }

TEST(ImportIct, ThePublishedHeadIsExact) {
    BLUSH_SHARED_OR_SKIP(archive, "faces/ict-facekit/ict_expr.tar.xz");
    const Result<ImportedHead> head = import_ict(archive);
    const TemporaryFolder folder;
    const Result<Face> face = load_imported(head, folder);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_THAT(face->notes, IsEmpty());
    ASSERT_EQ(face->targets.size(), 57U);

    const std::set<std::string> compared = {"generic_neutral_mesh.obj", "jawOpen.obj", "eyeBlink_L.obj"};
    std::map<std::string, PlainObj> files;
    load::each_file(
        archive, [&](std::string_view name) { return compared.contains(std::string(load::file_name(name))); },
        [&](const std::string& name, const load::Bytes& bytes) {
            files[std::string(load::file_name(name))] = plain_obj({bytes.begin(), bytes.end()});
        });
    const PlainObj& neutral = files.at("generic_neutral_mesh.obj");
    EXPECT_EQ(neutral.positions.size(), 26'719U);
    EXPECT_EQ(face->indices.size() / 3, neutral.triangles);

    // Every corner of the file is a vertex with the same bits, and no vertex is anything else.
    std::map<Signature, std::vector<int>> vertices;
    for (const auto& [vertex, uv] : neutral.corners) {
        vertices[signature(glm::vec3(neutral.positions[static_cast<std::size_t>(vertex)]),
                           neutral.uv[static_cast<std::size_t>(uv)])]
            .push_back(vertex);
    }
    std::set<Signature> seen;
    std::vector<int> source(face->positions.size(), -1);
    for (std::size_t v = 0; v < face->positions.size(); ++v) {
        const auto found = vertices.find(signature(face->positions[v], face->uv0[v]));
        ASSERT_NE(found, vertices.end()) << "vertex " << v;
        seen.insert(found->first);
        if (found->second.size() == 1) source[v] = found->second.front();
    }
    EXPECT_EQ(seen.size(), vertices.size());

    // Neutral plus delta is the expression, to the spacing of floats at a head's size.
    for (const auto& [name, file] :
         {std::pair("jawOpen", "jawOpen.obj"), std::pair("eyeBlinkLeft", "eyeBlink_L.obj")}) {
        const auto target = std::ranges::find(face->targets, name, &Target::name);
        ASSERT_NE(target, face->targets.end());
        std::vector<glm::vec3> moved = face->positions;
        for (std::size_t i = 0; i < target->vertices.size(); ++i)
            moved[target->vertices[i]] += target->position_deltas[i];
        double worst = 0;
        for (std::size_t v = 0; v < moved.size(); ++v) {
            if (source[v] < 0) continue;
            const glm::dvec3 wanted = files.at(file).positions[static_cast<std::size_t>(source[v])];
            worst = std::max(worst, glm::distance(glm::dvec3(moved[v]), wanted));
        }
        EXPECT_LT(worst, 2e-6) << name;  // centimetres; coordinates have 4 to 5 decimals there
    }

    // Normals of the target are those of the moved surface: unit length, and turned where it turned.
    const auto blink = std::ranges::find(face->targets, "eyeBlinkLeft", &Target::name);
    float longest = 0, shortest = 2;
    for (std::size_t i = 0; i < blink->vertices.size(); ++i) {
        const float length = glm::length(face->normals[blink->vertices[i]] + blink->normal_deltas[i]);
        longest = std::max(longest, length);
        shortest = std::min(shortest, length);
    }
    EXPECT_LT(longest, 1.001F);
    EXPECT_GT(shortest, 0.999F);

    std::set<std::string> materials;
    for (const Material& material : face->materials) materials.insert(material.name);
    EXPECT_THAT(materials,
                testing::IsSupersetOf({"skin", "sclera", "iris", "teeth", "gums", "lashes", "eyeOcclusion"}));
}

TEST(ImportMakeHuman, ThePublishedHeadHasItsTargetsPartsAndTextures) {
    BLUSH_SHARED_OR_SKIP(path, "faces/makehuman");
    const Result<ImportedHead> head = import_makehuman(path);
    const TemporaryFolder folder;
    const Result<Face> face = load_imported(head, folder);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_THAT(head->notes, IsEmpty());
    EXPECT_EQ(face->targets.size(), 52U + 15U);
    EXPECT_EQ(face->images.size(), 5U);
    std::set<std::string> nodes;
    for (const Node& node : face->nodes) nodes.insert(node.name);
    EXPECT_EQ(nodes,
              (std::set<std::string>{"makeHuman", "head", "eyeballLeft", "eyeballRight", "teeth", "tongue", "lashes"}));

    // The skin's vertices are the file's, bit for bit, and all of them lie above the collarbones.
    std::ifstream file(path / "base.obj");
    const PlainObj base = plain_obj({std::istreambuf_iterator<char>(file), {}});
    std::set<Signature> known;
    for (const auto& [vertex, uv] : base.corners) {
        known.insert(signature(glm::vec3(base.positions[static_cast<std::size_t>(vertex)]),
                               base.uv[static_cast<std::size_t>(uv)]));
    }
    const Primitive& skin = face->primitives[0];
    for (std::uint32_t v = 0; v < skin.vertex_count; ++v) {
        ASSERT_TRUE(known.contains(signature(face->positions[v], face->uv0[v]))) << v;
        EXPECT_GT(face->positions[v].y, 5.3F);
    }
    // Teeth do not grow when the jaw opens: the lower ones move together, the upper ones not at all.
    const auto jaw = std::ranges::find(face->targets, "jawOpen", &Target::name);
    const Primitive& teeth = face->primitives[face->meshes[3].first_primitive];
    EXPECT_EQ(face->meshes[3].name, "teeth");
    float highest = -1;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < jaw->vertices.size(); ++i) {
        if (jaw->vertices[i] - teeth.first_vertex >= teeth.vertex_count) continue;
        highest = std::max(highest, jaw->position_deltas[i].y);
        moved += glm::length(jaw->position_deltas[i]) > 0.01F ? 1U : 0U;
    }
    EXPECT_GT(moved, std::size_t{teeth.vertex_count} / 4);
    EXPECT_LT(moved, std::size_t{teeth.vertex_count} * 3 / 4);
    EXPECT_LT(highest, 0.05F);
}

}  // namespace
}  // namespace blush

// The registry of effects, their settings and the programs.

#include "runtime/frame/effect.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>

#include "runtime/effects/shared_settings.h"
#include "runtime/gl/program.h"
#include "shaders/embedded.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

bool is_sentence_like(std::string_view text) { return text.size() >= 10 && text.find(' ') != std::string_view::npos; }

TEST(Effects, HaveAllTheirFacesAndNamesOfTheirOwn) {
    std::set<std::string_view> names;
    ASSERT_FALSE(effects().empty());
    for (const Effect* effect : effects()) {
        ASSERT_NE(effect, nullptr);
        SCOPED_TRACE(effect->name);
        EXPECT_TRUE(names.insert(effect->name).second) << "the name is taken";
        EXPECT_TRUE(is_sentence_like(effect->what));
        // Asked once for the view or for each character.
        EXPECT_NE(effect->need != nullptr, effect->character_need != nullptr);
        ASSERT_FALSE(effect->hard_cases.empty());
        std::set<std::string_view> cases;
        for (const HardCase& hard : effect->hard_cases) {
            EXPECT_TRUE(cases.insert(hard.name).second) << hard.name;
            EXPECT_TRUE(is_sentence_like(hard.expectation)) << hard.name;
            EXPECT_NE(hard.make, nullptr) << hard.name;
        }
        std::set<std::string_view> settings;
        for (const Setting& setting : effect->settings) {
            EXPECT_TRUE(settings.insert(setting.name).second) << setting.name;
            EXPECT_TRUE(is_sentence_like(setting.meaning)) << setting.name;
            if (setting.choices.empty()) {
                EXPECT_LT(setting.lowest, setting.highest) << setting.name;
                EXPECT_GE(setting.default_number, setting.lowest) << setting.name;
                EXPECT_LE(setting.default_number, setting.highest) << setting.name;
                continue;
            }
            EXPECT_GE(setting.choices.size(), 2U) << setting.name;
            EXPECT_LT(setting.default_choice, setting.choices.size()) << setting.name;
            const std::set<std::string_view> choices(setting.choices.begin(), setting.choices.end());
            EXPECT_EQ(choices.size(), setting.choices.size()) << setting.name;
            for (const std::string_view choice : choices) {
                EXPECT_NE(setting.meaning.find(choice), std::string_view::npos) << choice << " is not explained";
            }
        }
    }
}

/// The text of a file in shaders/ or of the part's own.
std::string_view shader_text(const ShadingPart& part, std::string_view file) {
    for (const std::span<const EmbeddedShader> shaders : {embedded_shaders(), part.own_files}) {
        for (const EmbeddedShader& shader : shaders) {
            if (shader.name == file) return shader.text;
        }
    }
    return {};
}

TEST(Effects, PartsOfShadingHaveTheFunctionsOfTheirHooks) {
    std::string called;
    for (const EmbeddedShader& shader : embedded_shaders()) called += shader.text;
    for (const Effect* effect : effects()) {
        if (effect->shading == nullptr) continue;
        SCOPED_TRACE(effect->name);
        const ShadingPart& part = *effect->shading;
        std::string text;
        for (const std::string_view file : {part.file, part.vertex_file, part.output_file}) {
            if (file.empty()) continue;
            EXPECT_FALSE(shader_text(part, file).empty()) << file;
            text += shader_text(part, file);
        }
        for (const std::string_view hook : part.hooks) {
            EXPECT_NE(called.find("#call " + std::string(hook) + "("), std::string::npos) << hook << " is no hook";
            EXPECT_NE(text.find("void " + std::string(effect->name) + "_" + std::string(hook) + "("), std::string::npos)
                << hook << " has no function";
        }
        EXPECT_TRUE(part.hooks.empty() == (part.gives_model != nullptr)) << "it has nothing to say";
        EXPECT_EQ(part.variants.empty(), part.variant == nullptr);
        EXPECT_EQ(part.textures != 0, text.find("_UNIT") != std::string::npos);
        // Every shader of a frame writes all of its targets.
        const bool everywhere =
            effect->need != nullptr && part.takes_part == nullptr && part.materials == all_materials;
        EXPECT_TRUE(part.targets.empty() || everywhere);
    }
}

TEST(Effects, UniformsOfShadingAgreeWithGlsl) {
    std::size_t bytes = 0;
    for (const Effect* effect : effects()) {
        if (effect->shading == nullptr || effect->shading->uniforms.bytes == 0) continue;
        SCOPED_TRACE(effect->name);
        const ShadingUniforms& uniforms = effect->shading->uniforms;
        EXPECT_EQ(uniforms.bytes % 16, 0U);
        EXPECT_NE(uniforms.write, nullptr);
        const std::string_view text = shader_text(*effect->shading, uniforms.file);
        EXPECT_NE(text.find("struct " + std::string(uniforms.type) + " {"), std::string_view::npos);
        ASSERT_FALSE(uniforms.fields.empty());
        for (const UniformField& field : uniforms.fields) EXPECT_LT(field.offset, uniforms.bytes) << field.name;
        bytes += uniforms.bytes;
    }
    EXPECT_LE(bytes, 16384U) << "more than a uniform block holds everywhere";
}

/// Whether a file names an effect: by its object, in quotes, or a file of its room.
std::optional<std::string> effect_named_in(const std::string& text) {
    for (const Effect* effect : effects()) {
        const std::string name(effect->name);
        for (const std::string& way : {name + "_effect", "\"" + name + "\"", "\"" + name + "."}) {
            if (text.find(way) != std::string::npos) return way;
        }
    }
    return std::nullopt;
}

TEST(Effects, AreNamedInTheirRoomsAlone) {
    namespace fs = std::filesystem;
    EXPECT_TRUE(effect_named_in("x.on(blood_effect)"));
    EXPECT_TRUE(effect_named_in("set(\"blood.shown\")"));
    const fs::path root(BLUSH_SOURCE_DIR);
    std::size_t files = 0;
    for (const char* room : {"runtime/frame", "runtime/draw", "runtime/gl", "runtime/deform", "shaders/draw",
                             "shaders/frame", "runtime"}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / room)) {
            if (!entry.is_regular_file()) continue;
            if (std::string_view(room) == "runtime" && entry.path().parent_path() != root / room) continue;
            std::ifstream in(entry.path());
            std::string text;
            for (std::string line; std::getline(in, line);) text += line.substr(0, line.find("//")) + "\n";
            const std::optional<std::string> named = effect_named_in(text);
            EXPECT_FALSE(named) << entry.path() << " names " << *named;
            ++files;
        }
    }
    EXPECT_GT(files, 60U);
}

TEST(EffectSettings, AreTheSameByNameAndByPlace) {
    for (const Effect* effect : effects()) {
        for (std::uint16_t s = 0; s < effect->settings.size(); ++s) {
            const Setting& setting = effect->settings[s];
            const std::string name = std::string(effect->name) + "." + std::string(setting.name);
            EffectSettings settings;
            const std::string value =
                setting.choices.empty() ? std::to_string(setting.highest) : std::string(setting.choices.back());
            ASSERT_TRUE(settings.set(name, value)) << name;
            const SettingId id{effect, s};
            EXPECT_EQ(settings.number(id), settings.number(effect->name, setting.name)) << name;
            EXPECT_EQ(EffectSettings().number(id), EffectSettings().number(effect->name, setting.name)) << name;
        }
    }
}

TEST(EffectSettings, ThatOthersReadAreThoseOfTheirNames) {
    for (const auto& [id, effect, setting] : {std::tuple(antialiasing_mode, "antialiasing", "mode"),
                                              {supersampling_factor, "supersampling", "factor"},
                                              {velocities_source, "velocities", "source"},
                                              {shadows_method, "shadows", "method"},
                                              {shadows_size, "shadows", "size"},
                                              {shadows_edges, "shadows", "edges"},
                                              {wrinkles_encoding, "wrinkles", "encoding"},
                                              {wrinkles_storage, "wrinkles", "storage"},
                                              {blood_colour, "blood", "colour"},
                                              {blood_table_nodes, "blood", "table_nodes"}}) {
        ASSERT_NE(id.effect, nullptr);
        EXPECT_EQ(id.effect->name, effect);
        EXPECT_EQ(id.effect->settings[id.place].name, setting);
    }
}

TEST(EffectSettings, StartAtTheirDefaultsAndTakeEveryChoice) {
    const EffectSettings defaults;
    for (const Effect* effect : effects()) {
        for (const Setting& setting : effect->settings) {
            const std::string name = std::string(effect->name) + "." + std::string(setting.name);
            if (setting.choices.empty()) {
                EXPECT_EQ(defaults.number(effect->name, setting.name), setting.default_number);
                EffectSettings settings;
                ASSERT_TRUE(settings.set(name, std::to_string(setting.highest)));
                EXPECT_NEAR(settings.number(effect->name, setting.name), setting.highest, 1e-6);
                EXPECT_FALSE(settings.set(name, std::to_string(2 * setting.highest + 1)));
                EXPECT_FALSE(settings.set(name, "nan"));
                EXPECT_FALSE(settings.set(name, "much"));
                continue;
            }
            EXPECT_EQ(defaults.choice(effect->name, setting.name), setting.default_choice);
            for (std::uint8_t c = 0; c < setting.choices.size(); ++c) {
                EffectSettings settings;
                ASSERT_TRUE(settings.set(name, setting.choices[c]));
                EXPECT_EQ(settings.choice(effect->name, setting.name), c);
                EXPECT_EQ(settings == defaults, c == setting.default_choice);
            }
        }
    }
}

TEST(EffectSettings, SayWhatThereIsInstead) {
    EffectSettings settings;
    Status status = settings.set("deformation.methods", "sparse");
    ASSERT_FALSE(status);
    const std::string& message = status.error().message;
    EXPECT_TRUE(message.starts_with(
        "no setting is called \"deformation.methods\" (there are: deformation.method, normals.source"))
        << message;
    EXPECT_TRUE(message.ends_with(")")) << message;

    status = settings.set("normals.source", "guessed");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message,
              "setting normals.source has no choice \"guessed\" (there are: authored, recomputed)");
    EXPECT_EQ(settings, EffectSettings());
    EXPECT_FALSE(settings.set("deformation", "sparse"));
    EXPECT_FALSE(settings.set("", ""));
}

TEST(ExpandShader, ResolvesEachIncludeOnceAfterVersionAndDefines) {
    const std::vector<std::string_view> defines = {"HAS_NORMAL_DELTAS"};
    const Result<std::string> text = gl::expand_shader("deform/deform.vert", defines);
    ASSERT_TRUE(text);
    EXPECT_TRUE(text->starts_with("#version 450 core\n#define HAS_NORMAL_DELTAS\n"));
    EXPECT_EQ(text->find("#include"), std::string::npos);
    const auto count = [&](std::string_view part) {
        std::size_t found = 0;
        for (std::size_t at = text->find(part); at != std::string::npos; at = text->find(part, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("BLUSH_UNIFORM_BLOCK(FrameBlock"), 1U);
    EXPECT_EQ(count("vec3 turned_normal("), 1U);
    EXPECT_EQ(count("void main()"), 1U);
}

TEST(ExpandShader, AMissingFileIsNamed) {
    for (const std::string_view file : {"nothing.vert", "../shared.glsl", ""}) {
        const Result<std::string> text = gl::expand_shader(file, {});
        ASSERT_FALSE(text);
        EXPECT_EQ(text.error().message, "shader " + std::string(file) + " is not in the library");
    }
}

TEST(EmbeddedShaders, EveryShaderExpandsSoNoIncludeIsMissing) {
    EXPECT_GE(embedded_shaders().size(), 10U);
    for (const EmbeddedShader& shader : embedded_shaders()) {
        const Result<std::string> text = gl::expand_shader(shader.name, {});
        EXPECT_TRUE(text) << shader.name << ": " << (text ? "" : text.error().message);
    }
}

class Programs : public test::GlTest {
protected:
    /// A vertex program whose only block is `block`; it reads every field, so that the driver keeps all of them.
    static GLuint link(const std::string& block, const std::string& position) {
        const std::string text = "#version 450 core\nlayout(std140, binding = 1) uniform " + block +
                                 ";\nvoid main() { gl_Position = " + position + "; }\n";
        const char* source = text.c_str();
        const GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glLinkProgram(program);
        glDeleteShader(shader);
        GLint linked = 0;
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
        EXPECT_EQ(linked, GL_TRUE);
        return program;
    }
    static constexpr const char* reads_all = "world_from_mesh * world_normal_from_mesh * vec4(1.0)";
};

TEST_F(Programs, ABlockThatMatchesPasses) {
    const gl::Program program(link("DrawBlock { mat4 world_from_mesh; mat4 world_normal_from_mesh; }", reads_all));
    const Status status = gl::check_blocks(program.name(), "test.vert");
    EXPECT_TRUE(status) << status.error().message;
}

TEST_F(Programs, ABlockOfAnotherSizeIsNamed) {
    const gl::Program program(
        link("DrawBlock { mat4 world_from_mesh; mat4 world_normal_from_mesh; vec4 more; }", reads_all));
    const Status status = gl::check_blocks(program.name(), "test.vert");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "shader test.vert: block DrawBlock has 144 bytes in the driver and 128 in C++");
}

TEST_F(Programs, AFieldAtAnotherPlaceIsNamed) {
    const gl::Program program(link("DrawBlock { mat4 world_normal_from_mesh; mat4 world_from_mesh; }", reads_all));
    const Status status = gl::check_blocks(program.name(), "test.vert");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message,
              "shader test.vert: DrawBlock.world_from_mesh stands at byte 64 in the driver and 0 in C++");
}

TEST_F(Programs, AProgramOfAMissingShaderIsAnError) {
    const Result<gl::Program> program = gl::make_program({"screen.vert", "nothing.frag"});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().message, "shader nothing.frag is not in the library");
}

TEST(BrokenPrograms, AShaderThatDoesNotCompileIsNamedWithTheLog) {
    const Result<Device> quiet = Device::headless(false);  // the driver is meant to complain
    ASSERT_TRUE(quiet);
    // Every vec4 of the text becomes nothing, which no grammar allows.
    const std::vector<std::string_view> nonsense = {"vec4"};
    const Result<gl::Program> program = gl::make_program({"screen.vert", "camera/tone.frag", nonsense});
    ASSERT_FALSE(program);
    EXPECT_TRUE(program.error().message.starts_with("shader screen.vert does not compile: "))
        << program.error().message;
    EXPECT_TRUE(quiet->debug_messages().empty());
}

}  // namespace
}  // namespace blush

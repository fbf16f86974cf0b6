// The registry of effects, their settings and the programs.

#include "runtime/frame/effect.h"

#include <gtest/gtest.h>

#include <set>

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

// Devices: our own, the host's, several at a time, and how long they live.

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>

#include "runtime/gl/program.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

/// A host's own context, made as a host would: OpenGL 4.5, or OpenGL ES.
class HostContext {
public:
    explicit HostContext(EGLenum api = EGL_OPENGL_API) {
        display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        eglInitialize(display_, nullptr, nullptr);
        eglBindAPI(api);
        const bool desktop = api == EGL_OPENGL_API;
        const std::array<EGLint, 5> attributes = {EGL_CONTEXT_MAJOR_VERSION, desktop ? 4 : 3, EGL_CONTEXT_MINOR_VERSION,
                                                  desktop ? 5 : 0, EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        make_current();
    }
    ~HostContext() {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }
    HostContext(const HostContext&) = delete;
    HostContext& operator=(const HostContext&) = delete;
    bool exists() const { return context_ != EGL_NO_CONTEXT; }
    bool is_current() const { return eglGetCurrentContext() == context_; }
    void make_current() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }
    void release() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

Image picture_of(const Device& device, Portrait& character) {
    const Result<Offscreen> offscreen = Offscreen::create(device, 40, 40, Output::display_srgb);
    EXPECT_TRUE(offscreen);
    return test::draw(character, *offscreen);
}

class Devices : public test::GlTest {};

TEST(AdoptCurrent, WithoutAContextIsAnError) {
    const Result<Device> device = Device::adopt_current();
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().message, "no GL context is current on this thread");
}

TEST(AdoptCurrent, AContextThatIsNotOpenGl45IsAnError) {
    const HostContext host(EGL_OPENGL_ES_API);
    ASSERT_TRUE(host.exists());
    const Result<Device> device = Device::adopt_current();
    ASSERT_FALSE(device);
    EXPECT_TRUE(device.error().message.starts_with("the GL context is \"OpenGL ES 3")) << device.error().message;
    EXPECT_TRUE(device.error().message.ends_with("\"; blush needs OpenGL 4.5")) << device.error().message;
}

TEST_F(Devices, AnAdoptedContextDrawsWhatAnOwnOneDraws) {
    const Face face = test::make_face({.targets = 2});
    Portrait own = make_character(face);
    const Image expected = picture_of(device_, own);

    const HostContext host;
    ASSERT_TRUE(host.exists());
    const Result<Device> adopted = Device::adopt_current();
    ASSERT_TRUE(adopted) << adopted.error().message;
    EXPECT_TRUE(host.is_current());
    {
        Portrait character = make_character(*adopted, face);
        EXPECT_EQ(picture_of(*adopted, character).bytes, expected.bytes);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
    EXPECT_TRUE(host.is_current());
}

TEST_F(Devices, TwoDevicesAndTwoCharactersLiveSideBySide) {
    const Device other = make_device();
    const Face one = test::make_face({.targets = 2, .seed = 1}), two = test::make_face({.targets = 2, .seed = 9});
    Image expected[2];
    {
        Portrait character = make_character(one);
        test::set_weights(character, {1, 0});
        expected[0] = picture_of(device_, character);
    }
    {
        Portrait character = make_character(two);
        test::set_weights(character, {1, 1});
        expected[1] = picture_of(device_, character);
    }
    ASSERT_NE(expected[0].bytes, expected[1].bytes);

    Portrait on_first = make_character(device_, one), on_second = make_character(other, two);
    Portrait also_on_first = make_character(device_, two);
    for (int frame = 0; frame < 2; ++frame) {
        test::set_weights(on_first, {1, 0});
        test::set_weights(on_second, {1, 1});
        test::set_weights(also_on_first, {1, 1});
        EXPECT_EQ(picture_of(device_, on_first).bytes, expected[0].bytes);
        EXPECT_EQ(picture_of(other, on_second).bytes, expected[1].bytes);
        EXPECT_EQ(picture_of(device_, also_on_first).bytes, expected[1].bytes);
    }
    test::expect_no_debug_messages(other);
}

TEST_F(Devices, ACharacterOutlivesTheDeviceVariable) {
    std::optional<Device> handle = make_device();
    Portrait character = make_character(*handle, test::make_face({.targets = 1}));
    const Result<Offscreen> offscreen = Offscreen::create(*handle, 40, 40, Output::display_srgb);
    ASSERT_TRUE(offscreen);
    const Image before = test::draw(character, *offscreen);
    handle.reset();
    EXPECT_EQ(test::draw(character, *offscreen).bytes, before.bytes);
}

TEST_F(Devices, AssigningOverACharacterDeletesItsObjectsInTheirOwnContext) {
    // Names of objects are counted alike in both contexts: deleting those of one in the other would hit the survivor.
    const Device other = make_device();
    const Face face = test::make_face({.targets = 1});
    Portrait on_first = make_character(device_, face), on_second = make_character(other, face);
    std::optional<Portrait> survivor = make_character(other, face);
    const Image expected = picture_of(other, *survivor);
    on_first = std::move(on_second);  // `other` is current here, and the objects that go are of the first device
    EXPECT_EQ(picture_of(other, *survivor).bytes, expected.bytes);
    EXPECT_EQ(picture_of(other, on_first).bytes, expected.bytes);
    test::expect_no_debug_messages(other);
}

TEST_F(Devices, AssigningOverAnOffscreenDeletesItsObjectsInTheirOwnContext) {
    const Device other = make_device();
    Portrait character = make_character(other, test::make_face({.targets = 1}));
    const Image expected = picture_of(other, character);
    Offscreen on_first = make_offscreen(40, 40);
    Result<Offscreen> on_second = Offscreen::create(other, 40, 40, Output::display_srgb);
    Result<Offscreen> second_on_second = Offscreen::create(other, 40, 40, Output::display_srgb);
    ASSERT_TRUE(on_second);
    ASSERT_TRUE(second_on_second);
    on_first = *std::move(second_on_second);
    EXPECT_EQ(test::draw(character, *on_second).bytes, expected.bytes);
    EXPECT_EQ(test::draw(character, on_first).bytes, expected.bytes);
    test::expect_no_debug_messages(other);
}

/// In every mode of antialiasing, whose passes are the most programs.
TEST_F(Devices, ASecondCharacterCompilesNothing) {
    const Face face = test::make_face({.targets = 1, .joints = true});
    const auto draw_all = [&] {
        Portrait character = make_character(face);
        for (const char* mode : {"none", "msaa4", "mlaa", "smaa_1x", "smaa_4x"}) {
            ASSERT_TRUE(character.set("antialiasing.mode", mode));
            for (const float weight : {0.0F, 1.0F}) {
                test::set_weights(character, {weight});
                picture_of(device_, character);
            }
        }
    };
    draw_all();
    const std::size_t compiled = gl::ProgramCache::current()->size();
    EXPECT_GT(compiled, 20U);
    draw_all();
    EXPECT_EQ(gl::ProgramCache::current()->size(), compiled);
}

/// Each has a context of its own, and programs are not shared between contexts.
TEST_F(Devices, EachKeepsItsOwnPrograms) {
    Portrait first = make_character(test::make_face({.targets = 1}));
    const std::size_t of_first = gl::ProgramCache::current()->size();
    const Device other = make_device();
    EXPECT_EQ(gl::ProgramCache::current()->size(), 0U);
    Portrait second = make_character(other, test::make_face({.targets = 1}));
    EXPECT_EQ(gl::ProgramCache::current()->size(), of_first);
    EXPECT_EQ(picture_of(device_, first).bytes, picture_of(other, second).bytes);
}

/// The host's context outlives the device: nothing is left in it.
TEST(AdoptCurrent, ADeviceTakesItsProgramsWithIt) {
    const HostContext host;
    {
        Result<Device> device = Device::adopt_current();
        ASSERT_TRUE(device);
        const Result<gl::Program> program = gl::make_program({"screen.vert", "camera/tone.frag"});
        ASSERT_TRUE(program);
        EXPECT_TRUE(glIsProgram(program->name()));
    }
    for (GLuint name = 1; name < 20; ++name) EXPECT_FALSE(glIsProgram(name));
    EXPECT_EQ(gl::ProgramCache::current(), nullptr);
    EXPECT_EQ(gl::make_program({"screen.vert", "camera/tone.frag"}).error().message,
              "no device is current on this thread");
}

}  // namespace
}  // namespace blush

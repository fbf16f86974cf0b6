#pragma once
/// A frame as passes that read and write named resources. The graph is walked back from what is presented: a pass that
/// nothing presented depends on is culled, and a transient resource exists only from its first to its last live use.
///
/// Knows nothing of GL: textures are made by a TextureSource, passes are callbacks.

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace blush {

enum class PixelFormat : std::uint8_t {
    r8,
    rg8,
    rgba8,
    r16f,
    rg16f,
    rgba16f,
    r32f,
    rg32f,
    rgba32f,
    depth32f,
    depth32f_stencil8,
    stencil8
};

struct TextureShape {
    PixelFormat format = PixelFormat::rgba16f;
    std::uint32_t width = 1, height = 1;
    std::uint32_t samples = 1;

    bool operator==(const TextureShape&) const = default;
};

/// What a resource is, as far as a check of its contents needs to know.
enum class ResourceKind : std::uint8_t {
    texture,       ///< transient, made by the TextureSource; or imported
    float_buffer,  ///< imported: an array of vertices of `components` floats
    framebuffer,   ///< imported: what is presented to
};

enum class ResourceId : std::uint32_t {};

struct FrameResource {
    std::string_view name;
    ResourceKind kind = ResourceKind::texture;
    TextureShape shape;            ///< of a texture or a framebuffer
    std::uint32_t components = 0;  ///< of a float buffer
    std::uint32_t count = 0;       ///< vertices of a float buffer
    std::uint32_t handle = 0;      ///< name of the object in its API; of a transient texture only while it is alive
    bool imported = false;         ///< lives longer than the frame
    std::int32_t first_use = -1, last_use = -1;  ///< live passes, by index; -1: never alive
    std::int32_t forwarded_to = -1;              ///< index of the resource that stands in its place; -1: none
};

/// Makes textures and takes them back; keeps them from frame to frame.
class TextureSource {
public:
    virtual ~TextureSource() = default;
    virtual std::uint32_t acquire(const TextureShape& shape) = 0;
    virtual void release(std::uint32_t handle, const TextureShape& shape) = 0;
};

class FrameGraph;

struct FramePass {
    std::string_view name;
    std::function<void(const FrameGraph&)> run;
    std::uint32_t first_use = 0, use_count = 0;  ///< into the graph's list of uses
    bool live = false;
};

class FrameGraph {
public:
    /// Forgets all passes and resources; keeps the memory.
    void clear();

    /// All names are kept as views: pass literals, or strings that outlive the frame.
    ResourceId texture(std::string_view name, const TextureShape& shape);
    /// A texture of the caller's, which outlives the frame.
    ResourceId import_texture(std::string_view name, std::uint32_t handle, const TextureShape& shape);
    ResourceId import_buffer(std::string_view name, std::uint32_t handle, std::uint32_t components,
                             std::uint32_t count);
    ResourceId import_framebuffer(std::string_view name, std::uint32_t handle, const TextureShape& shape);

    /// Adds a pass; reads(), writes() and modifies() that follow are its. `run` must be small enough that std::function
    /// keeps it without an allocation: capture at most two pointers.
    template <class Run>
    FrameGraph& pass(std::string_view name, Run run) {
        static_assert(sizeof(Run) <= 2 * sizeof(void*) && std::is_trivially_copyable_v<Run>,
                      "a pass captures two pointers at most, so that declaring a frame does not allocate");
        add_pass(name, std::function<void(const FrameGraph&)>(run));
        return *this;
    }
    FrameGraph& reads(ResourceId resource);
    FrameGraph& writes(ResourceId resource);    ///< starts it anew: what was in it before is not needed
    FrameGraph& modifies(ResourceId resource);  ///< needs what earlier passes wrote
    void present(ResourceId resource);
    /// What passes write to the transient `from` goes to `to` instead, an imported texture or framebuffer of the same
    /// size: the maker of a picture need not know where it will end. Before compile().
    void forward(ResourceId from, ResourceId to);

    /// Culls and finds lifetimes. Call once, after the last pass.
    void compile();

    /// Runs the live passes in the order in which they were added. `before` and `after` may be empty.
    using Observer = std::function<void(const FrameGraph&, const FramePass&)>;
    void execute(TextureSource& textures, const Observer& before = {}, const Observer& after = {});

    std::span<const FramePass> passes() const { return passes_; }
    std::span<const FrameResource> resources() const { return resources_; }
    const FrameResource& operator[](ResourceId id) const { return resources_[place_of(id)]; }

    /// Calls `visit` with each resource that `pass` writes or modifies.
    template <class Visit>
    void each_output(const FramePass& pass, Visit visit) const {
        for (const Use& use : std::span(uses_).subspan(pass.first_use, pass.use_count)) {
            if (use.access != Access::read) visit((*this)[use.resource]);
        }
    }

private:
    enum class Access : std::uint8_t { read, write, modify };
    struct Use {
        ResourceId resource{};
        Access access = Access::read;
    };

    void add_pass(std::string_view name, std::function<void(const FrameGraph&)> run);
    FrameGraph& use(ResourceId resource, Access access);
    ResourceId add_resource(FrameResource resource);
    /// Index of the resource that `id` stands for, after forwarding.
    std::uint32_t place_of(ResourceId id) const {
        const FrameResource& resource = resources_[static_cast<std::uint32_t>(id)];
        return resource.forwarded_to < 0 ? static_cast<std::uint32_t>(id)
                                         : static_cast<std::uint32_t>(resource.forwarded_to);
    }

    std::vector<FramePass> passes_;
    std::vector<FrameResource> resources_;
    std::vector<Use> uses_;
    std::vector<std::uint8_t> wanted_;  // of each resource: presented, or read by a live pass further on
    std::vector<ResourceId> presented_;
};

}  // namespace blush

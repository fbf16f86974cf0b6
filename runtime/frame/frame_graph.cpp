#include "runtime/frame/frame_graph.h"

#include <algorithm>
#include <cassert>

namespace blush {

void FrameGraph::clear() {
    passes_.clear();
    resources_.clear();
    uses_.clear();
    presented_.clear();
}

ResourceId FrameGraph::add_resource(FrameResource resource) {
    resources_.push_back(resource);
    return static_cast<ResourceId>(resources_.size() - 1);
}

ResourceId FrameGraph::texture(std::string_view name, const TextureShape& shape) {
    return add_resource({.name = name, .kind = ResourceKind::texture, .shape = shape});
}

ResourceId FrameGraph::import_texture(std::string_view name, std::uint32_t handle, const TextureShape& shape) {
    return add_resource(
        {.name = name, .kind = ResourceKind::texture, .shape = shape, .handle = handle, .imported = true});
}

ResourceId FrameGraph::import_buffer(std::string_view name, std::uint32_t handle, std::uint32_t components,
                                     std::uint32_t count) {
    return add_resource({.name = name,
                         .kind = ResourceKind::float_buffer,
                         .shape = {},
                         .components = components,
                         .count = count,
                         .handle = handle,
                         .imported = true});
}

ResourceId FrameGraph::import_framebuffer(std::string_view name, std::uint32_t handle, const TextureShape& shape) {
    return add_resource(
        {.name = name, .kind = ResourceKind::framebuffer, .shape = shape, .handle = handle, .imported = true});
}

void FrameGraph::add_pass(std::string_view name, std::function<void(const FrameGraph&)> run) {
    passes_.push_back({name, std::move(run), static_cast<std::uint32_t>(uses_.size()), 0, false});
}

FrameGraph& FrameGraph::use(ResourceId resource, Access access) {
    assert(!passes_.empty() && "FrameGraph: a use before the first pass");
    assert(static_cast<std::uint32_t>(resource) < resources_.size() && "FrameGraph: a resource of another graph");
    uses_.push_back({resource, access});
    ++passes_.back().use_count;
    return *this;
}

FrameGraph& FrameGraph::reads(ResourceId resource) { return use(resource, Access::read); }
FrameGraph& FrameGraph::writes(ResourceId resource) { return use(resource, Access::write); }
FrameGraph& FrameGraph::modifies(ResourceId resource) { return use(resource, Access::modify); }
void FrameGraph::present(ResourceId resource) { presented_.push_back(resource); }

void FrameGraph::forward(ResourceId from, ResourceId to) {
    FrameResource& source = resources_[place_of(from)];
    const std::uint32_t target = place_of(to);
    assert(!source.imported && resources_[target].imported && "FrameGraph::forward: a transient to what is imported");
    source.forwarded_to = static_cast<std::int32_t>(target);
}

void FrameGraph::compile() {
    wanted_.assign(resources_.size(), 0);
    for (Use& use : uses_) use.resource = static_cast<ResourceId>(place_of(use.resource));
    for (const ResourceId id : presented_) wanted_[place_of(id)] = 1;

    // Backwards: a pass is live when something further on wants what it writes. A plain write satisfies the want, so
    // that whatever wrote the resource before it is not wanted for it.
    for (std::size_t index = passes_.size(); index-- > 0;) {
        FramePass& pass = passes_[index];
        const auto uses = std::span(uses_).subspan(pass.first_use, pass.use_count);
        pass.live = std::ranges::any_of(uses, [&](const Use& use) {
            return use.access != Access::read && wanted_[static_cast<std::uint32_t>(use.resource)] != 0;
        });
        if (!pass.live) continue;
        for (const Use& use : uses) {
            if (use.access == Access::write) wanted_[static_cast<std::uint32_t>(use.resource)] = 0;
        }
        for (const Use& use : uses) {
            if (use.access != Access::write) wanted_[static_cast<std::uint32_t>(use.resource)] = 1;
        }
    }

    for (std::size_t index = 0; index < passes_.size(); ++index) {
        const FramePass& pass = passes_[index];
        if (!pass.live) continue;
        for (const Use& use : std::span(uses_).subspan(pass.first_use, pass.use_count)) {
            FrameResource& resource = resources_[static_cast<std::uint32_t>(use.resource)];
            if (resource.first_use < 0) resource.first_use = static_cast<std::int32_t>(index);
            resource.last_use = static_cast<std::int32_t>(index);
        }
    }
}

void FrameGraph::execute(TextureSource& textures, const Observer& before, const Observer& after) {
    for (std::size_t index = 0; index < passes_.size(); ++index) {
        const FramePass& pass = passes_[index];
        if (!pass.live) continue;
        for (FrameResource& resource : resources_) {
            if (!resource.imported && resource.first_use == static_cast<std::int32_t>(index)) {
                resource.handle = textures.acquire(resource.shape);
            }
        }
        if (before) before(*this, pass);
        pass.run(*this);
        if (after) after(*this, pass);
        for (FrameResource& resource : resources_) {
            if (!resource.imported && resource.last_use == static_cast<std::int32_t>(index)) {
                textures.release(resource.handle, resource.shape);
            }
        }
    }
}

}  // namespace blush

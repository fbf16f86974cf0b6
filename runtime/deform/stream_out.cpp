#include "runtime/deform/stream_out.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "rig/deform/face_part.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

constexpr std::size_t vec3_bytes = sizeof(glm::vec3), vec4_bytes = sizeof(glm::vec4);
constexpr std::array<const char*, 3> surface_outputs = {"deformed_position", "deformed_normal", "deformed_tangent"};
constexpr std::array<const char*, 2> normal_outputs = {"deformed_normal", "deformed_tangent"};

void attribute(const gl::VertexArray& array, GLuint location, GLint components) {
    glEnableVertexArrayAttrib(array.name(), location);
    glVertexArrayAttribFormat(array.name(), location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array.name(), location, location);
}

void source(const gl::VertexArray& array, GLuint location, const gl::Buffer& buffer, std::size_t stride,
            std::size_t offset = 0) {
    glVertexArrayVertexBuffer(array.name(), location, buffer.name(), static_cast<GLintptr>(offset),
                              static_cast<GLsizei>(stride));
}

void bind_block(GLuint binding, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

/// Makes `buffer` hold at least `bytes`, doubling so that growth is rare, and writes `data` to its start.
void upload(gl::Buffer& buffer, std::size_t& capacity, const void* data, std::size_t bytes) {
    if (!buffer || capacity < bytes) {
        capacity = std::max(bytes * 2, std::size_t{256});
        buffer = gl::make_buffer(capacity, nullptr, GL_DYNAMIC_STORAGE_BIT);
    }
    if (bytes != 0) glNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(bytes), data);
}

}  // namespace

Result<std::shared_ptr<DeformModel>> DeformModel::create(const Device& device, const Face& face,
                                                         std::uint64_t largest_block_bytes) {
    std::shared_ptr<DeformModel> model(new DeformModel(face));
    if (largest_block_bytes == 0) largest_block_bytes = device.info().largest_storage_block_bytes;
    if (Status built = model->build(largest_block_bytes, device.info().renderer); !built) return built.error();
    return model;
}

Status DeformModel::build(std::uint64_t largest_block_bytes, const std::string& renderer) {
    const Face& face = *face_;
    rest_.positions = gl::make_buffer<glm::vec3>(face.positions);
    rest_.normals = gl::make_buffer<glm::vec3>(face.normals);
    rest_.tangents = gl::make_buffer<glm::vec4>(face.tangents);

    moved_ranges_ = ranges(NormalMethod::authored);
    moved_ranges_recomputed_ = ranges(NormalMethod::recomputed);
    has_normal_deltas_ = std::ranges::any_of(face.targets, [](const Target& t) { return !t.normal_deltas.empty(); });
    has_tangent_deltas_ = std::ranges::any_of(face.targets, [](const Target& t) { return !t.tangent_deltas.empty(); });
    if (Status pages = build_pages(largest_block_bytes, renderer); !pages) return pages;

    std::vector<std::string_view> defines;
    if (has_normal_deltas_) defines.emplace_back("HAS_NORMAL_DELTAS");
    if (has_tangent_deltas_) defines.emplace_back("HAS_TANGENT_DELTAS");
    const auto program = [&](gl::Program& out, const gl::ProgramSource& text) -> Status {
        Result<gl::Program> made = gl::make_program(text);
        if (!made) return made.error();
        out = *std::move(made);
        return Done{};
    };
    for (Status made : {program(sparse_program_, {"deform/deform.vert", {}, defines, surface_outputs}),
                        program(pass_program_, {"deform/deform_pass.vert", {}, defines, surface_outputs}),
                        program(normals_program_, {"deform/normals.vert", {}, {}, normal_outputs}),
                        program(skin_program_, {"deform/skin.vert", {}, {}, surface_outputs})}) {
        if (!made) return made;
    }

    vertex_array_ = gl::make_vertex_array();
    attribute(vertex_array_, BLUSH_POSITION_ATTRIBUTE, 3);
    attribute(vertex_array_, BLUSH_NORMAL_ATTRIBUTE, 3);
    attribute(vertex_array_, BLUSH_TANGENT_ATTRIBUTE, 4);
    attribute(vertex_array_, BLUSH_REST_NORMAL_ATTRIBUTE, 3);
    attribute(vertex_array_, BLUSH_REST_TANGENT_ATTRIBUTE, 4);
    source(vertex_array_, BLUSH_REST_NORMAL_ATTRIBUTE, rest_.normals, vec3_bytes);
    source(vertex_array_, BLUSH_REST_TANGENT_ATTRIBUTE, rest_.tangents, vec4_bytes);
    feedback_ = gl::make_transform_feedback();

    // Without a surface, transform feedback needs a framebuffer that is complete, even though nothing is drawn.
    no_attachments_ = gl::make_framebuffer();
    glNamedFramebufferParameteri(no_attachments_.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glNamedFramebufferParameteri(no_attachments_.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);

    if (!face.joints.empty()) {
        joint_indices_ = gl::make_buffer<glm::u16vec4>(face.joints);
        joint_weights_ = gl::make_buffer<glm::vec4>(face.joint_weights);
        // A primitive without a skin has zero joint weights and passes through.
        first_joint_of_primitive_ = first_joints(face);
    }
    return Done{};
}

Status DeformModel::build_pages(std::uint64_t largest_block_bytes, const std::string& renderer) {
    const Face& face = *face_;
    sparse_ = std::make_unique<SparseBlocks>(face);
    const std::uint64_t largest = largest_block_bytes / vec3_bytes;
    const auto target_count = static_cast<std::uint32_t>(face.targets.size());

    std::uint32_t first = 0;
    while (first < target_count) {
        std::uint32_t last = first;
        const std::uint32_t first_delta = sparse_->first_delta[first];
        while (last < target_count && sparse_->first_delta[last + 1] - first_delta <= largest) ++last;
        if (last == first) {
            return Error{face.path + ": target \"" + face.targets[first].name + "\" moves " +
                         std::to_string(face.targets[first].vertices.size()) + " vertices; " + renderer + " holds " +
                         std::to_string(largest) + " in one block"};
        }
        Page page;
        page.first_target = first;
        page.last_target = last;
        page.first_delta = first_delta;
        const std::size_t deltas = sparse_->first_delta[last] - first_delta;
        const auto gather = [&](std::vector<glm::vec3> Target::*member) {
            std::vector<glm::vec3> gathered;
            gathered.reserve(deltas);
            for (std::uint32_t t = first; t < last; ++t) {
                const std::vector<glm::vec3>& part = face.targets[t].*member;
                gathered.insert(gathered.end(), part.begin(), part.end());
                gathered.resize(sparse_->first_delta[t + 1] - first_delta, glm::vec3(0));
            }
            return gl::make_buffer<glm::vec3>(gathered);
        };
        page.positions = gather(&Target::position_deltas);
        page.normals = has_normal_deltas_ ? gather(&Target::normal_deltas) : gl::make_buffer(0, nullptr);
        page.tangents = has_tangent_deltas_ ? gather(&Target::tangent_deltas) : gl::make_buffer(0, nullptr);
        pages_.push_back(std::move(page));
        first = last;
    }
    return Done{};
}

std::vector<DeformModel::Range> DeformModel::ranges(NormalMethod method) const {
    std::vector<Range> result;
    for (const Primitive& primitive : face_->primitives) {
        if (primitive.normal_source == NormalSource::rest) continue;
        const bool recomputed = normals_recomputed(primitive, method);
        if (!result.empty() && result.back().recomputed == recomputed &&
            result.back().first + result.back().count == primitive.first_vertex) {
            result.back().count += primitive.vertex_count;
        } else {
            result.push_back({primitive.first_vertex, primitive.vertex_count, recomputed});
        }
    }
    return result;
}

StreamOut::StreamOut(std::shared_ptr<DeformModel> model) : model_(std::move(model)) {
    for (std::size_t p = 0; p < model_->pages_.size(); ++p) {
        ActiveList list;
        list.first_entry = gl::make_buffer((model_->sparse_->block_count + 1) * sizeof(std::uint32_t), nullptr,
                                           GL_DYNAMIC_STORAGE_BIT);
        list.entries = gl::make_buffer(0, nullptr);
        lists_.push_back(std::move(list));
    }
    weights_ = gl::make_buffer(0, nullptr);
    if (!model_->face().joints.empty()) skinned_ = model_->make_surface();
}

/// What no target moves stays as it is at rest.
void StreamOut::prepare() {
    if (deformed_.positions) return;
    deformed_ = model_->make_surface();
    const std::size_t count = model_->face().positions.size();
    if (count == 0) return;
    const auto copy = [&](const gl::Buffer& from, const gl::Buffer& to, std::size_t stride) {
        glCopyNamedBufferSubData(from.name(), to.name(), 0, 0, static_cast<GLsizeiptr>(count * stride));
    };
    copy(rest().positions, deformed_.positions, vec3_bytes);
    copy(rest().normals, deformed_.normals, vec3_bytes);
    copy(rest().tangents, deformed_.tangents, vec4_bytes);
}

void StreamOut::set_active(std::span<const ActiveTarget> active) {
    prepare();
    const bool same_set =
        lists_built_ && std::ranges::equal(active, active_, {}, &ActiveTarget::target, &ActiveTarget::target);
    active_.assign(active.begin(), active.end());
    active_weights_.clear();
    for (const ActiveTarget& entry : active_) active_weights_.push_back(entry.weight);
    upload(weights_, weights_capacity_, active_weights_.data(), active_weights_.size() * sizeof(float));
    if (same_set) return;
    lists_built_ = true;
    const SparseBlocks& sparse = *model_->sparse_;
    BlockLists& made = model_->lists_;
    for (std::size_t p = 0; p < lists_.size(); ++p) {
        const DeformModel::Page& page = model_->pages_[p];
        ActiveList& list = lists_[p];
        made.build(sparse, active_, page.first_target, page.last_target);
        glNamedBufferSubData(list.first_entry.name(), 0,
                             static_cast<GLsizeiptr>(made.first_entry.size() * sizeof(std::uint32_t)),
                             made.first_entry.data());
        upload(list.entries, list.entry_capacity, made.entries.data(), made.entries.size() * sizeof(BlockEntry));
        list.deltas = 0;
        for (const ActiveTarget& entry : active_) {
            if (entry.target < page.first_target || entry.target >= page.last_target) continue;
            list.deltas += sparse.first_delta[entry.target + 1] - sparse.first_delta[entry.target];
        }
    }
}

void DeformModel::begin(const gl::Program& program) {
    glUseProgram(program.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, no_attachments_.name());
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_.name());
    glEnable(GL_RASTERIZER_DISCARD);
}

void DeformModel::bind_source(const SurfaceBuffers& surface) {
    source(vertex_array_, BLUSH_POSITION_ATTRIBUTE, surface.positions, vec3_bytes);
    source(vertex_array_, BLUSH_NORMAL_ATTRIBUTE, surface.normals, vec3_bytes);
    source(vertex_array_, BLUSH_TANGENT_ATTRIBUTE, surface.tangents, vec4_bytes);
    glBindVertexArray(vertex_array_.name());
}

void DeformModel::stream(const Range& range, const SurfaceBuffers& destination) {
    const auto part = [&](GLuint index, const gl::Buffer& buffer, std::size_t stride) {
        glTransformFeedbackBufferRange(feedback_.name(), index, buffer.name(),
                                       static_cast<GLintptr>(range.first * stride),
                                       static_cast<GLsizeiptr>(range.count * stride));
    };
    part(0, destination.positions, vec3_bytes);
    part(1, destination.normals, vec3_bytes);
    part(2, destination.tangents, vec4_bytes);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, static_cast<GLint>(range.first), static_cast<GLsizei>(range.count));
    glEndTransformFeedback();
}

SurfaceBuffers DeformModel::make_surface() const {
    const std::size_t count = face_->positions.size();
    return {gl::make_buffer(count * vec3_bytes, nullptr), gl::make_buffer(count * vec3_bytes, nullptr),
            gl::make_buffer(count * vec4_bytes, nullptr)};
}

SurfaceBuffers& DeformModel::scratch(std::size_t index) {
    if (!scratch_[index].positions) scratch_[index] = make_surface();
    return scratch_[index];
}

void StreamOut::add_targets_sparse(NormalMethod method) {
    DeformModel& model = *model_;
    model.begin(model.sparse_program_);
    work_ = {};
    const std::vector<Range>& moved =
        method == NormalMethod::authored ? model.moved_ranges_ : model.moved_ranges_recomputed_;
    // Pages without an active target are skipped, but one pass has to run even when nothing is active.
    std::size_t last_page = 0;
    for (std::size_t p = 0; p < lists_.size(); ++p) {
        if (lists_[p].deltas != 0) last_page = p;
    }
    const SurfaceBuffers* from = &model.rest_;
    for (std::size_t p = 0; p < lists_.size(); ++p) {
        const DeformModel::Page& page = model.pages_[p];
        const ActiveList& list = lists_[p];
        const bool last = p == last_page;
        if (list.deltas == 0 && !last) continue;
        const SurfaceBuffers& to = last ? deformed_ : model.scratch(work_.passes % 2);
        model.bind_source(*from);
        bind_block(BLUSH_FIRST_ENTRY_BINDING, list.first_entry);
        bind_block(BLUSH_ENTRIES_BINDING, list.entries);
        bind_block(BLUSH_WEIGHTS_BINDING, weights_);
        bind_block(BLUSH_POSITION_DELTAS_BINDING, page.positions);
        bind_block(BLUSH_NORMAL_DELTAS_BINDING, page.normals);
        bind_block(BLUSH_TANGENT_DELTAS_BINDING, page.tangents);
        glUniform1ui(0, page.first_delta);
        glUniform1i(1, last ? 1 : 0);
        for (const Range& range : moved) {
            glUniform1i(2, range.recomputed ? 1 : 0);
            model.stream(range, to);
        }
        ++work_.passes;
        work_.deltas += list.deltas;
        from = &to;
        if (last) break;
    }
    glDisable(GL_RASTERIZER_DISCARD);
}

gl::Buffer& DeformModel::dense_target(std::uint32_t index) {
    // Keeps every target of a usual face resident and bounds the memory of an unusual one.
    constexpr std::size_t most_resident = 256;
    const auto found = dense_targets_.find(index);
    if (found != dense_targets_.end()) return found->second;
    if (dense_targets_.size() >= most_resident) dense_targets_.clear();

    const Target& target = face_->targets[index];
    const std::size_t count = face_->positions.size();
    std::vector<glm::vec3> dense(count * (has_tangent_deltas_ ? 3 : 2), glm::vec3(0));
    const auto scatter = [&](const std::vector<glm::vec3>& deltas, std::size_t section) {
        for (std::size_t i = 0; i < deltas.size(); ++i) dense[section * count + target.vertices[i]] = deltas[i];
    };
    scatter(target.position_deltas, 0);
    scatter(target.normal_deltas, 1);
    if (has_tangent_deltas_) scatter(target.tangent_deltas, 2);
    return dense_targets_.emplace(index, gl::make_buffer<glm::vec3>(dense)).first->second;
}

void StreamOut::add_targets_in_passes(NormalMethod method) {
    DeformModel& model = *model_;
    model.begin(model.pass_program_);
    work_ = {};
    const std::size_t targets_a_pass =
        model.has_tangent_deltas_ ? BLUSH_TARGETS_A_PASS_WITH_TANGENTS : BLUSH_TARGETS_A_PASS;
    const std::size_t attributes_a_target = model.has_tangent_deltas_ ? 3 : 2;
    const std::size_t section_bytes = model.face_->positions.size() * vec3_bytes;
    const std::vector<Range>& moved =
        method == NormalMethod::authored ? model.moved_ranges_ : model.moved_ranges_recomputed_;
    for (GLuint i = 0; i < targets_a_pass * attributes_a_target; ++i) {
        attribute(model.vertex_array_, BLUSH_TARGET_ATTRIBUTE + i, 3);
    }

    const std::size_t passes = std::max<std::size_t>(1, (active_.size() + targets_a_pass - 1) / targets_a_pass);
    const SurfaceBuffers* from = &model.rest_;
    for (std::size_t pass = 0; pass < passes; ++pass) {
        const bool last = pass + 1 == passes;
        const SurfaceBuffers& to = last ? deformed_ : model.scratch(pass % 2);
        const std::size_t first = pass * targets_a_pass;
        const std::size_t in_pass = std::min(targets_a_pass, active_.size() - first);
        std::array<float, BLUSH_TARGETS_A_PASS> weights{};
        for (std::size_t k = 0; k < targets_a_pass; ++k) {
            if (k < in_pass) weights[k] = active_[first + k].weight;
            for (std::size_t part = 0; part < attributes_a_target; ++part) {
                const auto location = static_cast<GLuint>(BLUSH_TARGET_ATTRIBUTE + k * attributes_a_target + part);
                if (k < in_pass) {
                    source(model.vertex_array_, location, model.dense_target(active_[first + k].target), vec3_bytes,
                           part * section_bytes);
                } else {
                    source(model.vertex_array_, location, model.rest_.normals, vec3_bytes);  // bound, not read
                }
            }
        }
        model.bind_source(*from);
        glUniform1fv(0, static_cast<GLsizei>(targets_a_pass), weights.data());
        glUniform1i(4, static_cast<GLint>(in_pass));
        glUniform1i(5, last ? 1 : 0);
        for (const Range& range : moved) {
            glUniform1i(6, range.recomputed ? 1 : 0);
            model.stream(range, to);
        }
        ++work_.passes;
        work_.deltas += in_pass * model.face_->positions.size();
        from = &to;
    }
    for (GLuint i = 0; i < targets_a_pass * attributes_a_target; ++i) {
        glDisableVertexArrayAttrib(model.vertex_array_.name(), BLUSH_TARGET_ATTRIBUTE + i);
    }
    glDisable(GL_RASTERIZER_DISCARD);
}

void DeformModel::ensure_topology() {
    if (first_triangle_) return;
    const NormalTopology topology(*face_);
    first_triangle_ = gl::make_buffer<std::uint32_t>(topology.first_triangle);
    triangles_ = gl::make_buffer<glm::uvec3>(topology.triangles);
    rest_sums_ = gl::make_buffer<glm::vec3>(topology.rest_sums);
    normals_vertex_array_ = gl::make_vertex_array();
    attribute(normals_vertex_array_, BLUSH_REST_NORMAL_ATTRIBUTE, 3);
    attribute(normals_vertex_array_, BLUSH_REST_TANGENT_ATTRIBUTE, 4);
    attribute(normals_vertex_array_, BLUSH_REST_SUM_ATTRIBUTE, 3);
    source(normals_vertex_array_, BLUSH_REST_NORMAL_ATTRIBUTE, rest_.normals, vec3_bytes);
    source(normals_vertex_array_, BLUSH_REST_TANGENT_ATTRIBUTE, rest_.tangents, vec4_bytes);
    source(normals_vertex_array_, BLUSH_REST_SUM_ATTRIBUTE, rest_sums_, vec3_bytes);
}

void StreamOut::turn_normals(NormalMethod method) {
    DeformModel& model = *model_;
    model.ensure_topology();
    model.begin(model.normals_program_);
    glBindVertexArray(model.normals_vertex_array_.name());
    bind_block(BLUSH_POSITIONS_BINDING, deformed_.positions);
    bind_block(BLUSH_FIRST_TRIANGLE_BINDING, model.first_triangle_);
    bind_block(BLUSH_TRIANGLES_BINDING, model.triangles_);
    glTransformFeedbackBufferBase(model.feedback_.name(), 2, 0);
    for (const Range& range : method == NormalMethod::authored ? model.moved_ranges_ : model.moved_ranges_recomputed_) {
        if (!range.recomputed) continue;
        glTransformFeedbackBufferRange(model.feedback_.name(), 0, deformed_.normals.name(),
                                       static_cast<GLintptr>(range.first * vec3_bytes),
                                       static_cast<GLsizeiptr>(range.count * vec3_bytes));
        glTransformFeedbackBufferRange(model.feedback_.name(), 1, deformed_.tangents.name(),
                                       static_cast<GLintptr>(range.first * vec4_bytes),
                                       static_cast<GLsizeiptr>(range.count * vec4_bytes));
        glBeginTransformFeedback(GL_POINTS);
        glDrawArrays(GL_POINTS, static_cast<GLint>(range.first), static_cast<GLsizei>(range.count));
        glEndTransformFeedback();
    }
    glDisable(GL_RASTERIZER_DISCARD);
}

void StreamOut::skin(const SurfaceBuffers& from, std::span<const glm::mat4> skinned_from_mesh) {
    DeformModel& model = *model_;
    const Face& face = model.face();
    assert(!face.joints.empty() && "StreamOut::skin: the face has no joints");
    upload(joints_, joints_capacity_, skinned_from_mesh.data(), skinned_from_mesh.size_bytes());
    model.begin(model.skin_program_);
    bind_block(BLUSH_JOINTS_BINDING, joints_);
    const gl::VertexArray& array = model.vertex_array_;
    glEnableVertexArrayAttrib(array.name(), BLUSH_JOINTS_ATTRIBUTE);
    glVertexArrayAttribIFormat(array.name(), BLUSH_JOINTS_ATTRIBUTE, 4, GL_UNSIGNED_SHORT, 0);
    glVertexArrayAttribBinding(array.name(), BLUSH_JOINTS_ATTRIBUTE, BLUSH_JOINTS_ATTRIBUTE);
    source(array, BLUSH_JOINTS_ATTRIBUTE, model.joint_indices_, sizeof(glm::u16vec4));
    attribute(array, BLUSH_JOINT_WEIGHTS_ATTRIBUTE, 4);
    source(array, BLUSH_JOINT_WEIGHTS_ATTRIBUTE, model.joint_weights_, vec4_bytes);
    model.bind_source(from);
    for (std::size_t p = 0; p < face.primitives.size(); ++p) {
        const Primitive& primitive = face.primitives[p];
        glUniform1ui(0, model.first_joint_of_primitive_[p]);
        model.stream({primitive.first_vertex, primitive.vertex_count, false}, skinned_);
    }
    glDisableVertexArrayAttrib(array.name(), BLUSH_JOINTS_ATTRIBUTE);
    glDisableVertexArrayAttrib(array.name(), BLUSH_JOINT_WEIGHTS_ATTRIBUTE);
    glDisable(GL_RASTERIZER_DISCARD);
}

}  // namespace blush

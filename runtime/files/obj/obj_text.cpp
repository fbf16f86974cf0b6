#include "runtime/files/obj/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

// OpenMesh compares all corners of a face with each other.
constexpr std::size_t most_corners = 1024;

struct Corner {
    std::size_t vertex = 0, uv = 0, normal = 0;  ///< from 1, 0: none
};

class ObjChecker {
public:
    ObjChecker(ByteView file, std::size_t vertex_limit)
        : text_(reinterpret_cast<const char*>(file.data()), file.size()), vertex_limit_(vertex_limit) {}

    ObjText run() {
        count_statements();
        std::string joined;
        while (next_line(joined)) statement(joined);
        if (skipped_faces_ > 0) {
            result_.notes.push_back(std::to_string(skipped_faces_) +
                                    " faces have fewer than three different corners and were left out");
        }
        if (std::ranges::any_of(result_.materials, [](const std::string& name) { return !name.empty(); })) {
            result_.notes.emplace_back("material files (.mtl) are not read; materials have their names only");
        }
        return std::move(result_);
    }

private:
    /// A face may name vertices that come after it, so all are counted before.
    void count_statements() {
        std::string joined;
        while (next_line(joined)) {
            std::string_view line = joined;
            const std::string_view keyword = word(line);
            if (keyword == "v") ++vertices_;
            if (keyword == "vt") ++uvs_;
            if (keyword == "vn") ++normals_;
        }
        if (vertices_ > vertex_limit_)
            refuse("", "the file has more than " + std::to_string(vertex_limit_) + " vertices");
        result_.vertex_count = vertices_;
        next_ = line_number_ = 0;
    }

    /// The next statement, with lines that end in a backslash joined.
    bool next_line(std::string& joined) {
        joined.clear();
        if (next_ >= text_.size()) return false;
        while (next_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', next_), text_.size());
            std::string_view line = text_.substr(next_, end - next_);
            next_ = end + 1;
            ++line_number_;
            if (line.ends_with('\r')) line.remove_suffix(1);
            const bool goes_on = line.ends_with('\\');
            if (goes_on) line.remove_suffix(1);
            joined += line;
            if (!goes_on) break;
            joined += ' ';
        }
        return true;
    }

    static std::string_view word(std::string_view& line) {
        const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
        const std::size_t end = std::min(line.find_first_of(" \t", first), line.size());
        const std::string_view found = line.substr(first, end - first);
        line.remove_prefix(end);
        return found;
    }

    [[noreturn]] void bad_line(std::string_view reason) const {
        refuse("line " + std::to_string(line_number_), reason);
    }

    void statement(std::string_view line) {
        const std::string_view keyword = word(line);
        if (keyword == "v") {
            ++vertices_so_far_;
            numbers("v", line, 3);
        } else if (keyword == "vt") {
            ++uvs_so_far_;
            numbers("vt", line, 2);
        } else if (keyword == "vn") {
            ++normals_so_far_;
            numbers("vn", line, 3);
        } else if (keyword == "f") {
            face(line);
        } else if (keyword == "usemtl") {
            material_ = std::string(word(line));
        }
    }

    void numbers(std::string_view keyword, std::string_view line, int count) {
        result_.text += keyword;
        for (int i = 0; i < count; ++i) {
            std::string_view text = word(line);
            if (text.starts_with('+')) text.remove_prefix(1);
            // A texture coordinate may leave out v.
            if (text.empty() && keyword == "vt" && i == 1) text = "0";
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool fits_float = std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
            if (error != std::errc() || end != text.data() + text.size() || !fits_float) {
                bad_line("\"" + std::string(text.substr(0, 40)) + "\" is not a finite number");
            }
            char buffer[32];
            result_.text += ' ';
            result_.text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(value)).ptr);
        }
        result_.text += '\n';
    }

    std::size_t index(std::string_view text, std::size_t all, std::size_t so_far, std::string_view what) const {
        long long value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size())
            bad_line("\"" + std::string(text.substr(0, 40)) + "\" is not an index");
        // Negative indices count back from the statement itself.
        if (value < 0) value += static_cast<long long>(so_far) + 1;
        if (value < 1 || static_cast<unsigned long long>(value) > all) {
            bad_line("\"" + std::string(text) + "\" names a " + std::string(what) +
                     " that does not exist, the file has " + std::to_string(all));
        }
        return static_cast<std::size_t>(value);
    }

    Corner corner(std::string_view text) const {
        Corner result;
        const std::size_t slash = text.find('/');
        result.vertex = index(text.substr(0, slash), vertices_, vertices_so_far_, "vertex");
        if (slash == std::string_view::npos) return result;
        text.remove_prefix(slash + 1);
        const std::size_t second = text.find('/');
        if (const auto uv = text.substr(0, second); !uv.empty())
            result.uv = index(uv, uvs_, uvs_so_far_, "texture coordinate");
        if (second == std::string_view::npos) return result;
        text.remove_prefix(second + 1);
        if (!text.empty()) result.normal = index(text, normals_, normals_so_far_, "normal");
        return result;
    }

    void face(std::string_view line) {
        corners_.clear();
        for (std::string_view text = word(line); !text.empty() && !text.starts_with('#'); text = word(line)) {
            const Corner next = corner(text);
            if (corners_.size() == most_corners)
                bad_line("a face has more than " + std::to_string(most_corners) + " corners");
            if (corners_.empty() || corners_.back().vertex != next.vertex) corners_.push_back(next);
        }
        while (corners_.size() > 1 && corners_.front().vertex == corners_.back().vertex) corners_.pop_back();
        std::vector<std::size_t> used(corners_.size());
        std::ranges::transform(corners_, used.begin(), &Corner::vertex);
        std::ranges::sort(used);
        if (corners_.size() < 3 || std::ranges::adjacent_find(used) != used.end()) {
            ++skipped_faces_;
            return;
        }
        const bool has_uv = std::ranges::all_of(corners_, [](const Corner& c) { return c.uv != 0; });
        result_.text += 'f';
        for (const Corner& c : corners_) {
            result_.text += ' ' + std::to_string(c.vertex);
            if (has_uv || c.normal != 0) result_.text += '/';
            if (has_uv) result_.text += std::to_string(c.uv);
            if (c.normal != 0) result_.text += '/' + std::to_string(c.normal);
        }
        result_.text += '\n';
        const auto [found, is_new] =
            material_index_.try_emplace(material_, static_cast<std::int32_t>(result_.materials.size()));
        if (is_new) result_.materials.push_back(material_);
        result_.face_materials.push_back(found->second);
    }

    std::string_view text_;
    std::size_t vertex_limit_;
    std::size_t next_ = 0, line_number_ = 0;
    std::size_t vertices_ = 0, uvs_ = 0, normals_ = 0;
    std::size_t vertices_so_far_ = 0, uvs_so_far_ = 0, normals_so_far_ = 0;
    std::size_t skipped_faces_ = 0;
    std::string material_;
    std::map<std::string, std::int32_t> material_index_;
    std::vector<Corner> corners_;
    ObjText result_;
};

}  // namespace

ObjText check_obj(ByteView file, std::size_t vertex_limit) { return ObjChecker(file, vertex_limit).run(); }

}  // namespace blush::load

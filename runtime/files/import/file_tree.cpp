#include "runtime/files/import/file_tree.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <vector>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_entries(const TreeLimits& limits) {
    refuse("", "it has more than " + std::to_string(limits.entries) + " entries");
}

/// Counts what comes out and refuses what is too much.
class Budget {
public:
    explicit Budget(const TreeLimits& limits) : limits_(limits) {}
    std::uint64_t left_for_a_file() const { return std::min(limits_.file_bytes, limits_.all_bytes - spent_); }
    void spend(std::uint64_t bytes) { spent_ += bytes; }
    void entry() {
        if (++entries_ > limits_.entries) refuse_entries(limits_);
    }

private:
    const TreeLimits& limits_;
    std::uint64_t spent_ = 0;
    std::size_t entries_ = 0;
};

void each_in_folder(const fs::path& folder, const std::function<bool(std::string_view)>& wanted,
                    const std::function<void(const std::string&, Bytes)>& use, Budget budget) {
    std::vector<std::string> names;
    std::error_code failed;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failed), end;
    for (; !failed && entry != end; entry.increment(failed)) {
        budget.entry();
        if (entry->is_symlink(failed) || !entry->is_regular_file(failed)) continue;
        std::string name = entry->path().lexically_relative(folder).generic_string();
        if (wanted(name)) names.push_back(std::move(name));
    }
    if (failed) refuse("", "the folder cannot be read (" + failed.message() + ")");
    std::ranges::sort(names);
    for (const std::string& name : names) {
        Bytes bytes = read_file(folder / name, budget.left_for_a_file(), name);
        budget.spend(bytes.size());
        use(name, std::move(bytes));
    }
}

struct Closer {
    void operator()(archive* a) const { archive_read_free(a); }
};

void refuse_when_it_leads_out(const std::string& name) {
    const fs::path path(name);
    const bool climbs = std::ranges::any_of(path, [](const fs::path& step) { return step == ".."; });
    if (path.is_absolute() || climbs) refuse(name.substr(0, 200), "the name leads out of the archive");
}

Bytes read_entry(archive* source, const std::string& name, std::uint64_t limit) {
    constexpr std::size_t step_bytes = 1 << 20;
    Bytes bytes;
    while (true) {
        const std::size_t before = bytes.size();
        bytes.resize(before + step_bytes);
        const la_ssize_t read = archive_read_data(source, bytes.data() + before, step_bytes);
        if (read < 0) {
            const char* reason = archive_error_string(source);
            refuse(name, std::string("the archive is broken here (") + (reason ? reason : "no reason given") + ")");
        }
        bytes.resize(before + static_cast<std::size_t>(read));
        if (bytes.size() > limit) {
            refuse(name, "the file has more than " + std::to_string(limit) + " bytes, which is all that may be read");
        }
        if (read == 0) return bytes;
    }
}

void each_in_archive(const fs::path& path, const std::function<bool(std::string_view)>& wanted,
                     const std::function<void(const std::string&, Bytes)>& use, Budget budget) {
    const std::unique_ptr<archive, Closer> source(archive_read_new());
    if (!source) throw std::bad_alloc();
    archive_read_support_filter_all(source.get());
    archive_read_support_format_all(source.get());
    constexpr std::size_t block_bytes = 64 << 10;
    if (archive_read_open_filename(source.get(), path.c_str(), block_bytes) != ARCHIVE_OK)
        refuse("", "this is neither a folder nor an archive that can be read");
    while (true) {
        archive_entry* entry = nullptr;
        const int found = archive_read_next_header(source.get(), &entry);
        if (found == ARCHIVE_EOF) return;
        if (found != ARCHIVE_OK && found != ARCHIVE_WARN) {
            const char* reason = archive_error_string(source.get());
            refuse("", std::string("the archive is broken (") + (reason ? reason : "no reason given") + ")");
        }
        budget.entry();
        const char* given = archive_entry_pathname(entry);
        if (!given) continue;
        std::string name = given;
        refuse_when_it_leads_out(name);
        name = fs::path(name).lexically_normal().generic_string();
        if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) || !wanted(name)) continue;
        Bytes bytes = read_entry(source.get(), name, budget.left_for_a_file());
        budget.spend(bytes.size());
        use(name, std::move(bytes));
    }
}

}  // namespace

std::string_view file_name(std::string_view name) {
    const std::size_t slash = name.rfind('/');
    return slash == std::string_view::npos ? name : name.substr(slash + 1);
}

void each_file(const fs::path& folder_or_archive, const std::function<bool(std::string_view)>& wanted,
               const std::function<void(const std::string&, Bytes)>& use, const TreeLimits& limits) {
    std::error_code failed;
    const fs::file_status status = fs::status(folder_or_archive, failed);
    if (!fs::exists(status)) refuse("", "there is no such file or folder");
    if (fs::is_directory(status)) return each_in_folder(folder_or_archive, wanted, use, Budget(limits));
    if (!fs::is_regular_file(status)) refuse("", "this is neither a folder nor a file");
    each_in_archive(folder_or_archive, wanted, use, Budget(limits));
}

}  // namespace blush::load

#include "runtime/files/performance/performance_file.h"

#include <cstdint>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "runtime/files/performance/csv_live_link.h"
#include "runtime/files/performance/performance_json.h"

namespace blush {
namespace {

namespace fs = std::filesystem;

/// Six hours of Live Link Face at 30 poses a second (84 MiB an hour).
constexpr std::uintmax_t most_bytes = 512U << 20;

Result<std::string> read_text(const fs::path& path, const std::string& file) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return Error{file + ": there is no such file"};
    if (!fs::is_regular_file(status)) return Error{file + ": is not a regular file"};
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return Error{file + ": " + error.message()};
    if (size > most_bytes) {
        return Error{file + ": a performance may have " + std::to_string(most_bytes >> 20) + " MiB, this has " +
                     std::to_string(size >> 20)};
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return Error{file + ": cannot be opened for reading"};
    std::string text(size, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size) return Error{file + ": cannot be read to its end"};
    return text;
}

Result<Performance> read_performance(const fs::path& path, const std::string& file) {
    const Result<std::string> contents = read_text(path, file);
    if (!contents) return contents.error();
    std::string_view text = *contents;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    if (text.find('\0') != std::string_view::npos) return Error{file + ": not a performance: it is not a text file"};
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return Error{file + ": the file is empty"};
    Result<Performance> performance =
        text[first] == '{' ? read_performance_json(text, file) : read_live_link_csv(text, file);
    if (performance && performance->name.empty()) performance->name = path.stem().string();
    return performance;
}

}  // namespace

Result<Performance> load_performance(const std::filesystem::path& path) {
    const std::string file = path.string();
    try {
        return read_performance(path, file);
    } catch (const std::exception& error) {  // out of memory, in practice
        return Error{file + ": " + error.what()};
    }
}

}  // namespace blush

#include "tools/blush/video.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

extern char** environ;

namespace blush::tool {

bool have_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (::access((folder + "/ffmpeg").c_str(), X_OK) == 0) return true;
    }
    return false;
}

Result<VideoWriter> VideoWriter::start(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                                       double frames_a_second) {
    std::vector<std::string> words = {"ffmpeg",    "-y",
                                      "-loglevel", "error",
                                      "-f",        "rawvideo",
                                      "-pix_fmt",  "rgba",
                                      "-s",        std::to_string(width) + "x" + std::to_string(height),
                                      "-r",        std::to_string(frames_a_second),
                                      "-i",        "pipe:0"};
    const auto add_words = [&](std::initializer_list<const char*> more) {
        words.insert(words.end(), more.begin(), more.end());
    };
    if (path.extension() == ".gif") {
        // One palette from all frames, so that skin does not flicker from frame to frame.
        add_words({"-vf", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer"});
    } else {
        // H.264 takes even sides only; quality 18 is visually without loss; yuv420p is what every player shows.
        add_words({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "18", "-preset", "medium",
                   "-pix_fmt", "yuv420p", "-threads", "2", "-movflags", "+faststart"});
    }
    // bitexact leaves out the encoder's version and the date.
    add_words({"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"});
    words.push_back(path.string());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    std::array<int, 2> pipe_ends{};
    if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return Error{"ffmpeg cannot be started: no pipe"};
    // Kept in memory: its first line becomes part of our one sentence.
    const int messages = ::memfd_create("ffmpeg", MFD_CLOEXEC);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[0], STDIN_FILENO);
    if (messages >= 0) posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
    pid_t process = -1;
    const int failed = ::posix_spawnp(&process, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe_ends[0]);
    if (failed != 0) {
        ::close(pipe_ends[1]);
        ::close(messages);
        return Error{"ffmpeg cannot be started"};
    }
    return VideoWriter(process, pipe_ends[1], messages);
}

VideoWriter::VideoWriter(VideoWriter&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      pipe_(std::exchange(other.pipe_, -1)),
      messages_(std::exchange(other.messages_, -1)) {}

VideoWriter::~VideoWriter() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    [[maybe_unused]] const Status ended = wait();
}

Status VideoWriter::add(const Image& frame) {
    std::size_t at = 0;
    while (at < frame.bytes.size()) {
        const ssize_t wrote = ::write(pipe_, frame.bytes.data() + at, frame.bytes.size() - at);
        if (wrote <= 0) {
            const Status ended = wait();
            return ended ? Error{"ffmpeg stopped before the last frame"} : ended.error();
        }
        at += static_cast<std::size_t>(wrote);
    }
    return Done{};
}

Status VideoWriter::wait() {
    ::close(std::exchange(pipe_, -1));
    int status = 0;
    ::waitpid(std::exchange(process_, -1), &status, 0);
    std::array<char, 400> text{};
    const ssize_t length = ::pread(messages_, text.data(), text.size(), 0);
    ::close(std::exchange(messages_, -1));
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return Done{};
    const std::string_view said(text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
    const std::string_view line = said.substr(0, said.find('\n'));
    return Error{"ffmpeg failed" + (line.empty() ? std::string() : ": " + std::string(line))};
}

Status VideoWriter::finish() { return wait(); }

}  // namespace blush::tool

#pragma once
/// A video written through the ffmpeg program, fed with raw frames.

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "rig/face.h"
#include "rig/result.h"

namespace blush::tool {

/// True when an ffmpeg program is on the PATH.
bool have_ffmpeg();

class VideoWriter {
public:
    /// .mp4 (H.264) or .gif, told by the ending of `path`. The same frames give the same bytes.
    static Result<VideoWriter> start(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                                     double frames_a_second);
    VideoWriter(VideoWriter&& other) noexcept;
    VideoWriter& operator=(VideoWriter&&) = delete;
    ~VideoWriter();  ///< a video that was not finished is given up: the encoder is ended

    /// RGBA bytes of the size given to start(). Error: the encoder has gone away.
    Status add(const Image& frame);
    /// Waits for the encoder. Error: it failed.
    Status finish();

private:
    VideoWriter(pid_t process, int pipe, int messages) : process_(process), pipe_(pipe), messages_(messages) {}
    Status wait();
    pid_t process_ = -1;
    int pipe_ = -1;
    int messages_ = -1;  ///< what ffmpeg writes to standard error
};

}  // namespace blush::tool

/// blush play: a performance into a window or into files.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "runtime/files/output_file.h"
#include "tools/blush/captions.h"
#include "tools/blush/commands.h"
#include "tools/blush/interrupt.h"
#include "tools/blush/new_folder.h"
#include "tools/blush/performing.h"
#include "tools/blush/playback.h"
#include "tools/blush/progress.h"
#include "tools/blush/shot.h"
#include "tools/blush/video.h"
#include "tools/blush/viewer.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

constexpr double most_seconds = 1e6;  // eleven days: a slip of the finger

struct Options {
    std::string face, performance, output, contact_sheet, first_frame;
    PoseOptions pose;
    PerformOptions perform;
    ShotOptions shot{.size = "720x720", .light = {}};
    bool captions = true;
    double frames_a_second = 30;
    float from_seconds = 0, to_seconds = -1;
    int viewer_frames = 0;
};

struct Range {
    double from_seconds = 0, to_seconds = 0;
    std::size_t frames = 1;
};

Result<Range> range_of(const Options& options, float duration_seconds) {
    const float to_seconds = options.to_seconds < 0 ? duration_seconds : options.to_seconds;
    Range range{static_cast<double>(options.from_seconds), static_cast<double>(to_seconds), 1};
    if (!(range.to_seconds >= range.from_seconds && range.from_seconds <= static_cast<double>(duration_seconds))) {
        return Error{"--from " + std::to_string(range.from_seconds) + " --to " + std::to_string(range.to_seconds) +
                     ": not a part of a performance of " + std::to_string(duration_seconds) + " seconds"};
    }
    const double frames = std::floor((range.to_seconds - range.from_seconds) * options.frames_a_second);
    constexpr double most_frames = 1e6;  // more than nine hours at 30 a second: a slip of the finger
    if (!(frames <= most_frames))
        return Error{"that would be " + std::to_string(frames) + " frames; a million is the most"};
    range.frames = static_cast<std::size_t>(frames) + 1;
    return range;
}

/// "frames/%05d.png" with a number; the pattern must hold one such place, in the file's name and not in a folder's, and
/// nothing else that begins with %.
std::optional<std::string> numbered(const std::string& pattern, std::size_t number) {
    const std::size_t percent = pattern.find('%');
    if (pattern.find('/', std::min(percent, pattern.size())) != std::string::npos) return std::nullopt;
    if (percent == std::string::npos || pattern.find('%', percent + 1) != std::string::npos) return std::nullopt;
    const std::size_t end = pattern.find_first_not_of("0123456789", percent + 1);
    if (end == std::string::npos || pattern[end] != 'd' || end > percent + 3) return std::nullopt;
    const std::string width = pattern.substr(percent + 1, end - percent - 1);
    std::string digits = std::to_string(number);
    const std::size_t wanted = width.empty() ? 0 : std::stoul(width);
    if (digits.size() < wanted) digits.insert(0, wanted - digits.size(), '0');
    return pattern.substr(0, percent) + digits + pattern.substr(end + 1);
}

/// Draws the frames of a range one after the other.
class FrameSource {
public:
    FrameSource(Playback& playback, Shot& shot, const Options& options)
        : playback_(playback), shot_(shot), frames_a_second_(options.frames_a_second) {
        if (options.captions && shot.output() == Output::display_srgb) captions_.emplace(shot.size().height);
    }
    /// alone: not the frame after the one drawn before.
    Result<Image> frame_at(double time_seconds, bool alone) {
        if (Status played = playback_.seek(time_seconds); !played) return played.error();
        const auto number = static_cast<std::uint32_t>(std::llround(time_seconds * frames_a_second_));
        const FrameReport report = shot_.draw(time_seconds, number, alone);
        if (report.not_finite) {
            return Error{"--check-finite: at " + std::to_string(time_seconds) + " s " + report.not_finite->sentence()};
        }
        Image image = shot_.read();
        if (captions_) captions_->draw(playback_.performer().caption(), image);
        return image;
    }
    Size size() const { return shot_.size(); }

private:
    Playback& playback_;
    Shot& shot_;
    double frames_a_second_;
    std::optional<Captions> captions_;
};

Status write_frames(FrameSource& source, const Options& options, const Range& range) {
    const bool video = fs::path(options.output).extension() == ".mp4" || fs::path(options.output).extension() == ".gif";
    Progress progress("frames", range.frames);
    const auto each = [&](const std::function<Status(std::size_t, const Image&)>& keep) -> Status {
        const Interruptible interruptible;
        for (std::size_t f = 0; f < range.frames; ++f) {
            if (interrupted()) {
                return Error{options.output + ": stopped after " + std::to_string(f) + " of " +
                             std::to_string(range.frames) + " frames"};
            }
            const double time = range.from_seconds + static_cast<double>(f) / options.frames_a_second;
            const Result<Image> image = source.frame_at(time, f == 0);
            if (!image) return image.error();
            if (Status kept = keep(f, *image); !kept) return kept;
            progress.step();
        }
        return Done{};
    };
    if (!video) {
        return each(
            [&](std::size_t f, const Image& image) { return write_image(*numbered(options.output, f), image); });
    }
    return write_beside(options.output, [&](const fs::path& beside) -> Status {
        const Size size = source.size();
        Result<VideoWriter> writer = VideoWriter::start(beside, size.width, size.height, options.frames_a_second);
        if (!writer) return writer.error();
        Status written = each([&](std::size_t, const Image& image) { return writer->add(image); });
        return written ? writer->finish() : written;
    });
}

/// Says at once that it is there: the other frames may take minutes.
Status write_first_frame(FrameSource& source, const Options& options, const Range& range) {
    const Result<Image> image = source.frame_at(range.from_seconds, true);
    if (!image) return image.error();
    if (Status written = write_image(options.first_frame, *image); !written) return written;
    std::cout << options.first_frame << ": the first frame" << std::endl;
    return Done{};
}

constexpr std::uint32_t sheet_columns = 4, sheet_rows = 2;

/// Checks before anything is drawn that a contact sheet can be written.
Status check_contact_sheet(const Options& options, Size frame) {
    const std::string place = "--contact-sheet " + options.contact_sheet;
    if (output_of(options.output) == Output::linear_hdr) {
        return Error{"--contact-sheet goes with pictures for a display, not with " +
                     fs::path(options.output).extension().string()};
    }
    if (fs::path(options.contact_sheet).extension() != ".png") return Error{place + ": a contact sheet is a .png"};
    constexpr std::uint32_t largest_side = 16'384;  // as of a frame
    if (frame.width > largest_side / sheet_columns || frame.height > largest_side / sheet_rows) {
        return Error{place + ": its moments may have " + std::to_string(largest_side / sheet_columns) + "x" +
                     std::to_string(largest_side / sheet_rows) + " pixels at most; --size says " + options.shot.size};
    }
    std::error_code failed;
    const fs::path folder = fs::path(options.contact_sheet).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, failed)) {
        return Error{options.contact_sheet + ": cannot be written: the folder " + folder.string() + " does not exist"};
    }
    if (fs::is_directory(options.contact_sheet, failed)) {
        return Error{options.contact_sheet + ": cannot be written: it is a folder"};
    }
    return Done{};
}

/// Eight moments of the range, two rows of four.
Status write_contact_sheet(FrameSource& source, const Options& options, const Range& range) {
    constexpr std::uint32_t columns = sheet_columns, rows = sheet_rows;
    Image sheet;
    for (std::uint32_t moment = 0; moment < columns * rows; ++moment) {
        // The middles of eight equal parts: the ends of a performance are mostly neutral.
        const double share = (moment + 0.5) / (columns * rows);
        const Result<Image> image =
            source.frame_at(range.from_seconds + share * (range.to_seconds - range.from_seconds), true);
        if (!image) return image.error();
        if (sheet.bytes.empty()) {
            sheet.width = columns * image->width;
            sheet.height = rows * image->height;
            sheet.channels = 4;
            sheet.bytes.resize(std::size_t{sheet.width} * sheet.height * 4);
        }
        const std::size_t left = std::size_t{moment % columns} * image->width,
                          top = std::size_t{moment / columns} * image->height;
        for (std::size_t y = 0; y < image->height; ++y) {
            std::copy_n(image->bytes.begin() + static_cast<std::ptrdiff_t>(y * image->width * 4), image->width * 4,
                        sheet.bytes.begin() + static_cast<std::ptrdiff_t>(((top + y) * sheet.width + left) * 4));
        }
    }
    return write_image(options.contact_sheet, sheet);
}

/// Checks what can be checked of the output before anything is drawn. Without ffmpeg a video becomes a sequence.
Status settle_output(Options& options, NewFolder& new_folder) {
    const fs::path output = options.output;
    const bool video = output.extension() == ".mp4" || output.extension() == ".gif";
    if (video && have_ffmpeg()) return Done{};
    if (video) {
        options.output = (output.parent_path() / output.stem() / "%05d.png").string();
    } else if (!numbered(options.output, 0)) {
        return Error{"-o " + options.output +
                     ": not a .mp4 or .gif, nor a numbered picture like frames/%05d.png or .exr"};
    }
    const fs::path folder = fs::path(options.output).parent_path();
    if (!folder.empty()) {
        if (Status made = new_folder.make(folder); !made) return made;
    }
    if (video) {
        std::cerr << "note: there is no ffmpeg program here (Debian: ffmpeg), so the frames go to " << options.output
                  << " instead of " << output.string() << "\n";
    }
    return Done{};
}

int play_to_files(Options options) {
    const Result<Size> size = parse_size(options.shot.size);
    if (!size) return fail(size.error());
    Result<std::unique_ptr<Stage>> stage = make_stage(options.face, options.pose);
    if (!stage) return fail(stage.error());
    Portrait& character = (*stage)->character;
    const Result<std::optional<BoundPerformance>> timeline =
        find_timeline(character.face(), character.rig(), options.performance, options.perform);
    if (!timeline) return fail(timeline.error());
    Result<PerformerParts> parts =
        options.perform.parts(character.face(), character.rig(), character.controls(), *timeline);
    if (!parts) return fail(parts.error());
    Playback playback(character, *std::move(parts));
    const Result<float> duration = duration_of(playback.performer(), 12);
    if (!duration) return fail(duration.error());
    const Result<Range> range = range_of(options, std::max(*duration, options.to_seconds));
    if (!range) return fail(range.error());
    if (!options.contact_sheet.empty()) {
        if (Status good = check_contact_sheet(options, *size); !good) return fail(good.error());
    }
    const Output output = output_of(options.output.empty() ? options.first_frame : options.output);
    if (!options.first_frame.empty() && output_of(options.first_frame) != output) {
        return fail({"--first-frame " + options.first_frame + ": -o " + options.output +
                     " holds other values; both may be .exr, or neither"});
    }
    NewFolder new_folder;
    if (!options.output.empty()) {
        if (Status settled = settle_output(options, new_folder); !settled) return fail(settled.error());
    }

    Result<Shot> shot = Shot::make(**stage, *size, options.shot, output);
    if (!shot) return fail(shot.error());
    FrameSource source(playback, *shot, options);
    if (!options.first_frame.empty()) {
        if (Status written = write_first_frame(source, options, *range); !written) return fail(written.error());
    }
    if (!options.output.empty()) {
        if (Status written = write_frames(source, options, *range); !written) return fail(written.error());
        std::cout << options.output << ": " << range->frames << " frames of " << options.shot.size << "\n";
    }
    if (!options.contact_sheet.empty()) {
        if (Status written = write_contact_sheet(source, options, *range); !written) return fail(written.error());
        std::cout << options.contact_sheet << ": eight moments\n";
    }
    return 0;
}

}  // namespace

void add_play(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("play", "Play a performance in a window, or into files with -o");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").required();
    command.option("--performance", &options->performance,
                   "A Live Link Face .csv, a .json (docs/performance_format.md), an animation of the file or a "
                   "shipped one by name; without it, the file's own animations");
    command.option("--fps", &options->frames_a_second, "Frames a second").range(0.01, 1000).shows_default();
    command.option("--from", &options->from_seconds, "Start, seconds").range(0, most_seconds);
    command.option("--to", &options->to_seconds, "End, seconds").range(0, most_seconds);
    options->pose.add_to(command);
    options->perform.add_to(command);
    options->shot.add_to(command);
    command.flag("!--no-captions", options->captions, "Leave the words of the performance out of the picture");
    command.option("-o,--output", &options->output, "out.mp4, out.gif, frames/%05d.png or frames/%05d.exr");
    command.option("--contact-sheet", &options->contact_sheet, "A picture of eight moments");
    command.option("--first-frame", &options->first_frame, "A picture of the first frame, written before the others");
    command.option("--viewer-frames", &options->viewer_frames, "Close the window after that many frames").hidden();
    command.runs([options] {
        if (!options->output.empty() || !options->contact_sheet.empty() || !options->first_frame.empty()) {
            return play_to_files(*options);
        }
        return run_viewer({.face = options->face,
                           .performance = options->performance,
                           .pose = options->pose,
                           .perform = options->perform,
                           .shot = options->shot,
                           .captions = options->captions,
                           .from_seconds = options->from_seconds,
                           .to_seconds = options->to_seconds,
                           .frames_a_second = options->frames_a_second,
                           .frames = options->viewer_frames});
    });
}

}  // namespace blush::tool

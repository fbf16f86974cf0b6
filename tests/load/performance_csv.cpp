#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/names.h"
#include "tests/load/performance_file.h"
#include "tests/shared_data.h"

namespace blush {
namespace {

using test::load_text;
using test::message_of;
using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<std::string> angle_titles = {"HeadYaw",     "HeadPitch",     "HeadRoll",
                                               "LeftEyeYaw",  "LeftEyePitch",  "LeftEyeRoll",
                                               "RightEyeYaw", "RightEyePitch", "RightEyeRoll"};

/// A recording as a table, so that a test changes one cell of it and writes it out.
struct Sheet {
    std::vector<std::string> header = {"Timecode", "BlendShapeCount"};
    std::vector<std::vector<std::string>> rows;

    explicit Sheet(const std::vector<std::string>& timecodes) {
        for (const std::string_view name : arkit_names) {
            std::string title(name);
            title[0] = static_cast<char>(title[0] - 'a' + 'A');
            header.push_back(title);
        }
        header.insert(header.end(), angle_titles.begin(), angle_titles.end());
        for (const std::string& timecode : timecodes) {
            std::vector<std::string> row(header.size(), "0.25");
            row[0] = timecode;
            row[1] = "61";
            rows.push_back(row);
        }
    }

    std::size_t column(std::string_view title) const {
        for (std::size_t i = 0; i < header.size(); ++i) {
            if (header[i] == title) return i;
        }
        ADD_FAILURE() << "no column " << title;
        return 0;
    }
    std::string& at(std::size_t row, std::string_view title) { return rows[row][column(title)]; }

    std::string text(const std::string& line_end = "\n") const {
        std::string result;
        const auto add = [&](const std::vector<std::string>& cells) {
            for (std::size_t i = 0; i < cells.size(); ++i) result += (i ? "," : "") + cells[i];
            result += line_end;
        };
        add(header);
        for (const auto& row : rows) add(row);
        return result;
    }
};

Sheet three_rows() { return Sheet({"10:00:00:00.000", "10:00:00:01.000", "10:00:00:02.000"}); }

const PerformanceChannel& channel(const Performance& performance, std::string_view name) {
    for (const PerformanceChannel& c : performance.channels) {
        if (c.name == name) return c;
    }
    ADD_FAILURE() << "no channel " << name;
    return performance.channels.front();
}

TEST(LiveLink, ReadsShapesTimesAndAngles) {
    Sheet sheet = three_rows();
    sheet.at(1, "JawOpen") = "0.75";
    sheet.at(1, "HeadYaw") = "0.1";
    sheet.at(1, "HeadPitch") = "0.2";
    sheet.at(1, "HeadRoll") = "0.3";
    sheet.at(2, "LeftEyeYaw") = "0";
    const auto loaded = load_text(sheet.text());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->channels.size(), 61U);
    EXPECT_THAT(loaded->notes, IsEmpty());
    EXPECT_FLOAT_EQ(loaded->duration_seconds, 2.0F / 30);
    const Track& jaw = channel(*loaded, "jawOpen").track;
    EXPECT_EQ(jaw.interpolation, Interpolation::linear);
    EXPECT_EQ(jaw.width, 1U);
    EXPECT_THAT(jaw.values, ElementsAre(0.25F, 0.75F, 0.25F));
    EXPECT_THAT(jaw.times_seconds, ElementsAre(0.0F, 1.0F / 30, 2.0F / 30));
    EXPECT_FLOAT_EQ(channel(*loaded, "headYaw").track.values[1], -0.1F);
    EXPECT_FLOAT_EQ(channel(*loaded, "headPitch").track.values[1], 0.2F);
    EXPECT_FLOAT_EQ(channel(*loaded, "headRoll").track.values[1], -0.3F);
    EXPECT_FALSE(std::signbit(channel(*loaded, "leftEyeYaw").track.values[2]));
}

TEST(LiveLink, ColumnsMayStandInAnyOrderAndStrangersBecomeChannels) {
    Sheet sheet = three_rows();
    sheet.at(0, "JawOpen") = "0.5";
    sheet.header.push_back("Tail");
    for (auto& row : sheet.rows) row.push_back("7");
    const auto reverse = [](std::vector<std::string>& cells) { std::reverse(cells.begin(), cells.end()); };
    reverse(sheet.header);
    for (auto& row : sheet.rows) reverse(row);
    const auto loaded = load_text(sheet.text());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(channel(*loaded, "jawOpen").track.values[0], 0.5F);
    EXPECT_EQ(channel(*loaded, "Tail").track.values[2], 7);
    EXPECT_THAT(loaded->notes, IsEmpty());
}

TEST(LiveLink, ByteOrderMarkWindowsLinesAndBlankLinesChangeNothing) {
    const Sheet sheet = three_rows();
    const auto plain = load_text(sheet.text());
    const auto windows = load_text("\xEF\xBB\xBF" + sheet.text("\r\n") + "\r\n\r\n");
    ASSERT_TRUE(plain && windows);
    ASSERT_EQ(plain->channels.size(), windows->channels.size());
    for (std::size_t i = 0; i < plain->channels.size(); ++i) {
        EXPECT_EQ(plain->channels[i].name, windows->channels[i].name);
        EXPECT_EQ(plain->channels[i].track.values, windows->channels[i].track.values);
        EXPECT_EQ(plain->channels[i].track.times_seconds, windows->channels[i].track.times_seconds);
    }
}

std::vector<float> times_of(const std::vector<std::string>& timecodes) {
    const auto loaded = load_text(Sheet(timecodes).text());
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message;
        return {};
    }
    return loaded->channels[0].track.times_seconds;
}

TEST(LiveLink, TheFrameNumberTellsWhetherASecondHas30Or60) {
    EXPECT_THAT(times_of({"00:00:01:00.5", "00:00:01:15.5", "00:00:02:00.5"}), ElementsAre(0, 0.5F, 1));
    EXPECT_THAT(times_of({"00:00:01:00.5", "00:00:01:30.5", "00:00:02:00.5"}), ElementsAre(0, 0.5F, 1));
    EXPECT_THAT(times_of({"00:00:01:00", "00:00:01:15", "00:00:01:59"}), ElementsAre(0, 0.25F, 59.0F / 60));
    EXPECT_THAT(times_of({"00:00:01.250", "00:00:01.500", "00:01:01.500"}), ElementsAre(0, 0.25F, 60.25F));
}

TEST(LiveLink, MidnightMayPassOnce) {
    EXPECT_THAT(times_of({"23:59:59:15", "00:00:00:00", "00:00:00:15"}), ElementsAre(0, 0.5F, 1));
    EXPECT_EQ(message_of(Sheet({"23:59:59:15", "00:00:00:00", "23:59:00:00", "00:00:00:00"}).text()),
              "row 5, column 'Timecode': 00:00:00:00 is earlier than the row before (23:59:00:00)");
}

TEST(LiveLink, DroppedFramesStayGapsAndAreCounted) {
    const std::vector<std::string> timecodes = {"00:00:00:00", "00:00:00:01", "00:00:00:04", "00:00:00:05",
                                                "00:00:00:06", "00:00:00:08", "00:00:00:09"};
    const auto loaded = load_text(Sheet(timecodes).text());
    ASSERT_TRUE(loaded);
    EXPECT_THAT(loaded->notes, ElementsAre("3 dropped frames in 2 places, first after row 3 (00:00:00:01)"));
    EXPECT_EQ(loaded->channels[0].track.times_seconds.size(), 7U);
    EXPECT_FLOAT_EQ(loaded->channels[0].track.times_seconds[2], 4.0F / 30);
}

TEST(LiveLink, ARepeatedTimecodeKeepsItsFirstRow) {
    Sheet sheet({"00:00:00:00", "00:00:00:01", "00:00:00:01", "00:00:00:02"});
    sheet.at(1, "JawOpen") = "0.1";
    sheet.at(2, "JawOpen") = "0.9";
    sheet.at(3, "JawOpen") = "0.2";
    const auto loaded = load_text(sheet.text());
    ASSERT_TRUE(loaded);
    EXPECT_THAT(channel(*loaded, "jawOpen").track.values, ElementsAre(0.25F, 0.1F, 0.2F));
    EXPECT_EQ(channel(*loaded, "jawOpen").track.times_seconds.size(), 3U);
    EXPECT_THAT(loaded->notes, ElementsAre("1 row repeats the timecode before and counts for nothing (first: row 4)"));
}

TEST(LiveLink, ValuesBeyondTheRangeAreKeptAndCounted) {
    Sheet sheet = three_rows();
    sheet.at(0, "JawOpen") = "1.5";
    sheet.at(2, "TongueOut") = "-0.75";
    sheet.at(2, "HeadYaw") = "3";  // an angle has no such range
    const auto loaded = load_text(sheet.text());
    ASSERT_TRUE(loaded);
    EXPECT_EQ(channel(*loaded, "jawOpen").track.values[0], 1.5F);
    EXPECT_EQ(channel(*loaded, "tongueOut").track.values[2], -0.75F);
    EXPECT_THAT(loaded->notes,
                ElementsAre("2 values beyond 0 to 1, kept as recorded (furthest: TongueOut -0.75 in row 4)"));
}

TEST(LiveLink, OneRowIsAStill) {
    const auto loaded = load_text(Sheet({"00:00:00:00"}).text());
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->duration_seconds, 0);
    EXPECT_THAT(loaded->channels[0].track.times_seconds, ElementsAre(0));
}

TEST(LiveLink, AnglesMayBeMissing) {
    Sheet sheet = three_rows();
    sheet.header.resize(54);
    for (auto& row : sheet.rows) row.resize(54);
    const auto loaded = load_text(sheet.text());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->channels.size(), 52U);
}

struct BadSheet {
    const char* what;
    std::function<void(Sheet&)> damage;
    const char* message;
};

TEST(LiveLink, EveryFaultHasItsSentence) {
    const std::vector<BadSheet> faults = {
        {"no rows", [](Sheet& s) { s.rows.clear(); }, "there is no row after the header"},
        {"no timecode", [](Sheet& s) { s.header[0] = "Clock"; },
         "row 1 has no column 'Timecode': this is neither a Live Link Face CSV nor a blush performance (JSON)"},
        {"no shape", [](Sheet& s) { s.header[s.column("JawOpen")] = "Jaw"; },
         "row 1 has no column for the shape 'jawOpen'"},
        {"twice", [](Sheet& s) { s.header[s.column("HeadYaw")] = "jaw_open"; },
         "row 1: column 'jaw_open' is there twice"},
        {"short row", [](Sheet& s) { s.rows[1].resize(5); }, "row 3, column 'EyeLookOutLeft': the row ends before it"},
        {"long row", [](Sheet& s) { s.rows[1].push_back("1"); }, "row 3 has 64 cells, the header has 63"},
        {"word", [](Sheet& s) { s.at(2, "JawOpen") = "wide"; }, "row 4, column 'JawOpen': 'wide' is not a number"},
        {"half a number", [](Sheet& s) { s.at(2, "JawOpen") = "0.5x"; },
         "row 4, column 'JawOpen': '0.5x' is not a number"},
        {"empty cell", [](Sheet& s) { s.at(2, "JawOpen") = " "; }, "row 4, column 'JawOpen': the cell is empty"},
        {"nan", [](Sheet& s) { s.at(0, "JawOpen") = "nan"; },
         "row 2, column 'JawOpen': 'nan' is not a finite number in a float's range"},
        {"inf", [](Sheet& s) { s.at(0, "HeadRoll") = "-inf"; },
         "row 2, column 'HeadRoll': '-inf' is not a finite number in a float's range"},
        {"huge", [](Sheet& s) { s.at(0, "JawOpen") = "1e39"; },
         "row 2, column 'JawOpen': '1e39' is not a finite number in a float's range"},
        {"beyond double", [](Sheet& s) { s.at(0, "JawOpen") = "1e999"; },
         "row 2, column 'JawOpen': '1e999' is not a finite number in a float's range"},
        {"unprintable", [](Sheet& s) { s.at(0, "JawOpen") = std::string(50, '\x01'); },
         "row 2, column 'JawOpen': '????????????????????????????????????????...' is not a number"},
        {"back", [](Sheet& s) { s.rows[2][0] = "10:00:00:00.500"; },
         "row 4, column 'Timecode': 10:00:00:00.500 is earlier than the row before (10:00:00:01.000)"},
    };
    for (const BadSheet& fault : faults) {
        Sheet sheet = three_rows();
        fault.damage(sheet);
        EXPECT_EQ(message_of(sheet.text()), fault.message) << fault.what;
    }
    for (const char* timecode :
         {"", "10", "10:00", "10:00:00:00:00", "24:00:00:00", "10:60:00:00", "10:00:60:00", "10:00:00:60",
          "10:00:00:-1", "10:00:00:1e1", "10:00:00:", "a:b:c:d", "nan:00:00:00"}) {
        Sheet sheet = three_rows();
        sheet.rows[1][0] = timecode;
        EXPECT_EQ(message_of(sheet.text()),
                  "row 3, column 'Timecode': '" + std::string(timecode) + "' is not HH:MM:SS:FF or HH:MM:SS.mmm");
    }
    EXPECT_EQ(message_of(std::string(5000, ',')), "row 1 has more than 4096 columns");
}

TEST(LiveLink, EveryTruncationLoadsOrHasASentence) {
    const std::string whole = three_rows().text();
    std::size_t refused = 0;
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        const std::string message = message_of(whole.substr(0, length));
        EXPECT_FALSE(message.starts_with("(does not")) << message;
        if (message != "(loads)") ++refused;
    }
    EXPECT_GT(refused, whole.size() / 14);
}

TEST(LiveLink, TheRealRecording) {
    BLUSH_SHARED_OR_SKIP(path, "performances/livelink/alex_rom_3.csv");
    const auto loaded = load_performance(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->name, "alex_rom_3");
    ASSERT_EQ(loaded->channels.size(), 61U);
    EXPECT_EQ(loaded->channels[0].track.times_seconds.size(), 4030U);
    EXPECT_NEAR(loaded->duration_seconds, 134.3818, 0.001);
    EXPECT_THAT(loaded->notes,
                ElementsAre("3 dropped frames in 3 places, first after row 597 (13:13:24:21.492)",
                            "1 value beyond 0 to 1, kept as recorded (furthest: EyeLookInRight 1.0033375 in row 545)"));
    // The sense of the angles: where an eye looks out, its yaw goes to its own side; looking down is positive pitch.
    const auto agree = [&](const char* angle, const char* more, const char* less, double sign) {
        const auto& a = channel(*loaded, angle).track.values;
        const auto& p = channel(*loaded, more).track.values;
        const auto& n = channel(*loaded, less).track.values;
        double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double x = static_cast<double>(a[i]), y = static_cast<double>(p[i]) - static_cast<double>(n[i]);
            sum_a += x, sum_b += y, aa += x * x, bb += y * y, ab += x * y;
        }
        const double count = static_cast<double>(a.size());
        const double correlation =
            (ab - sum_a * sum_b / count) / std::sqrt((aa - sum_a * sum_a / count) * (bb - sum_b * sum_b / count));
        EXPECT_GT(sign * correlation, 0.99) << angle;
    };
    agree("leftEyeYaw", "eyeLookOutLeft", "eyeLookInLeft", 1);
    agree("rightEyeYaw", "eyeLookOutRight", "eyeLookInRight", -1);
    agree("leftEyePitch", "eyeLookDownLeft", "eyeLookUpLeft", 1);
    agree("rightEyePitch", "eyeLookDownRight", "eyeLookUpRight", 1);
}

}  // namespace
}  // namespace blush

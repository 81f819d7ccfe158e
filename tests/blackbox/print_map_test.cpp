// Tests print maps. `calibrate --print-map` creates them, and `locate --print-map` and `watch
// --print-map` use them.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../mapped_print.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PrintMaps : public ToolCommand {
  protected:
    PrintMaps() {
        SheetFile sheets(directory_ / "sheets.json");
        sheets.add(print_.entry());
        sheets.save();
    }

    void put_frames(const std::string& name, const MappedPrint& print, std::uint64_t series,
                    int count) const {
        for (int i = 0; i < count; ++i) {
            const auto index = static_cast<std::uint64_t>(i);
            write_pgm(directory_ / fmt::format("{}-{:03}.pgm", name, i),
                      print.frame(print.pose(series, index), scramble(series + index)).view());
        }
    }

    /// Creates the print map desk.map from frames of the print.
    void make_map() {
        put_frames("map", print_, 100, 60);
        ASSERT_EQ(run("calibrate --print-map map-*.pgm --sheets sheets.json -o desk.map"), 0)
            << errors_;
    }

    /// Returns the records for the frames `NAME-*.pgm`.
    std::vector<json> located(const std::string& name, const std::string& options = "") {
        std::vector<json> records;
        run("locate --sheets sheets.json " + options + " " + name + "-*.pgm");
        for (const std::string& line : lines_of(output_))
            records.push_back(json::parse(line));
        return records;
    }

    /// Returns the rms of the position errors after subtracting the mean error. The mean error is
    /// subtracted because a map does not contain the mean offset of the dots, which is 0.2 µm on a
    /// page of this size.
    double error_um(const std::vector<json>& records, std::uint64_t series) const {
        const Sheet& sheet = print_.entry().sheet;
        const auto count = static_cast<double>(records.size());
        Vec2 sum;
        double squares = 0;
        for (std::size_t i = 0; i < records.size(); ++i) {
            const Vec2 at = print_.pose(series, i).at_mm;
            const double x = records[i].at("x_sheet_mm").get<double>() - at.x - sheet.origin_x_mm;
            const double y = records[i].at("y_sheet_mm").get<double>() - at.y - sheet.origin_y_mm;
            sum = {sum.x + x, sum.y + y};
            squares += x * x + y * y;
        }
        squares -= (sum.x * sum.x + sum.y * sum.y) / count;
        return 1000 * std::sqrt(squares / (2 * (count - 1)));
    }

    const MappedPrint print_{{.side_mm = 30, .wave_mm = 0}};
    const MappedPrint other_{{.side_mm = 30, .wave_mm = 0, .print = 2}};
};

TEST_F(PrintMaps, CorrectOtherFrames) {
    make_map();
    EXPECT_THAT(output_, HasSubstr("page: 60 of 60 frames"));
    put_frames("test", print_, 200, 12);
    const double without_um = error_um(located("test"), 200);
    const double with_um = error_um(located("test", "--print-map desk.map"), 200);
    EXPECT_EQ(exit_code_, 0) << errors_;
    EXPECT_GT(without_um, 0.2);
    EXPECT_LT(with_um, without_um / 2);
    EXPECT_THAT(output_, Not(HasSubstr("warning")));
}

TEST_F(PrintMaps, AreNotUsedForAnotherPrint) {
    make_map();
    put_frames("other", other_, 200, 4);
    const std::vector<json> without = located("other");
    const std::vector<json> with = located("other", "--print-map desk.map");
    EXPECT_EQ(exit_code_, 0) << errors_;
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        EXPECT_EQ(with[i].at("x_sheet_mm"), without[i].at("x_sheet_mm"));
        EXPECT_EQ(with[i].at("y_sheet_mm"), without[i].at("y_sheet_mm"));
        EXPECT_THAT(with[i].at("warning").get<std::string>(), HasSubstr("print map"));
        EXPECT_FALSE(without[i].contains("warning"));
    }
}

TEST_F(PrintMaps, OfAnotherPageAreRefused) {
    make_map();
    SheetEntry entry = print_.entry();
    entry.sheet.origin.x += 100;
    SheetFile sheets(directory_ / "moved.json");
    sheets.add(entry);
    sheets.save();
    for (const char* command : {"locate", "watch"}) {
        EXPECT_EQ(
            run(fmt::format("{} --sheets moved.json --print-map desk.map map-000.pgm", command)),
            1);
        EXPECT_THAT(errors_, HasSubstr("desk.map: the print map is of page 'page'"));
        EXPECT_THAT(errors_, HasSubstr("make a map of the pages of this file"));
    }
    EXPECT_EQ(run("calibrate --print-map map-*.pgm --sheets moved.json -o desk.map"), 1);
    EXPECT_THAT(errors_, HasSubstr("make a map of the pages of this file"));
}

TEST_F(PrintMaps, ThatAreDamagedAreRefused) {
    make_map();
    const std::string map = file("desk.map");
    std::string flipped = map;
    flipped[map.size() / 2] ^= 1;
    const auto refuses = [&](const std::string& bytes, const char* message) {
        std::ofstream(directory_ / "desk.map", std::ios::binary) << bytes;
        EXPECT_EQ(run("locate --sheets sheets.json --print-map desk.map map-000.pgm"), 1);
        EXPECT_THAT(errors_, HasSubstr(message));
        EXPECT_THAT(output_, Not(HasSubstr("x_sheet_mm")));
        EXPECT_EQ(run("calibrate --print-map map-*.pgm --sheets sheets.json -o desk.map"), 1);
        EXPECT_THAT(errors_, HasSubstr("name another file"));
        EXPECT_EQ(file("desk.map"), bytes);
    };
    refuses(map.substr(0, map.size() - 1), "make the map again");
    refuses(flipped, "make the map again");
    refuses("width_px: 640\n", "desk.map: it is not a print map of dotpose");
    EXPECT_EQ(run("locate --sheets sheets.json --print-map none.map map-000.pgm"), 1);
    EXPECT_THAT(errors_, HasSubstr("none.map does not exist"));
}

TEST_F(PrintMaps, AreUpdatedByALaterRun) {
    make_map();
    put_frames("later", print_, 300, 20);
    ASSERT_EQ(run("calibrate --print-map later-*.pgm --sheets sheets.json -o desk.map"), 0)
        << errors_;
    EXPECT_THAT(errors_, HasSubstr("desk.map exists: the frames update it"));
    EXPECT_THAT(output_, HasSubstr("page: 20 of 20 frames"));
    put_frames("test", print_, 200, 12);
    EXPECT_LT(error_um(located("test", "--print-map desk.map"), 200),
              error_um(located("test"), 200) / 2);
}

TEST_F(PrintMaps, AreNotUpdatedByFramesOfAnotherPrint) {
    make_map();
    const std::string map = file("desk.map");
    put_frames("other", other_, 300, 20);
    EXPECT_EQ(run("calibrate --print-map other-*.pgm --sheets sheets.json -o desk.map"), 1);
    EXPECT_THAT(errors_, HasSubstr("make a new map in another file"));
    EXPECT_EQ(file("desk.map"), map);
}

TEST_F(PrintMaps, NeedTheirOptions) {
    EXPECT_EQ(run("calibrate --print-map a.pgm -o desk.map"), 2);
    EXPECT_THAT(errors_, HasSubstr("--print-map needs --sheets FILE"));
    EXPECT_EQ(run("calibrate --print-map a.pgm --sheets sheets.json"), 2);
    EXPECT_THAT(errors_, HasSubstr("--print-map needs -o FILE"));
    EXPECT_EQ(run("locate --print-map desk.map a.pgm"), 2);
    EXPECT_THAT(errors_, HasSubstr("--sheets"));
    put_frames("few", print_, 100, 5);
    EXPECT_EQ(run("calibrate --print-map few-*.pgm --sheets sheets.json -o desk.map"), 1);
    EXPECT_THAT(errors_, HasSubstr("take frames all over a page"));
    EXPECT_FALSE(fs::exists(directory_ / "desk.map"));
}

}  // namespace
}  // namespace dotpose::test

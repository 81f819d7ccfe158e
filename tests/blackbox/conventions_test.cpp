// Tests the options that have the same meaning in all commands: `-o -` for standard output,
// --format and --draw.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "dotpose/tools/image_file.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kLog =
    "frame,t_s,file,status,dots_seen,p_wrong,state,events,verdict,plane,track_x_mm,track_y_mm,"
    "vx_mm_s,vy_mm_s\n"
    "0,0.0,,ok,150,1e-20,moving,fix,accepted,world,0,0,0,0\n"
    "1,0.1,,ok,150,1e-20,moving,,accepted,world,10,0,100,0\n";

class Conventions : public ToolCommand {
  protected:
    void SetUp() override { std::ofstream(directory_ / "run.csv") << kLog; }

    void put_frame() { write_pgm(directory_ / "a.pgm", render(shot(1)).view()); }

    /// Expects that the directory contains exactly the files in `names`. The names must be sorted,
    /// and each must be followed by a space.
    void expect_files(const std::string& names) {
        shell("ls -A | tr '\\n' ' '");
        EXPECT_EQ(output_, names);
    }
};

TEST_F(Conventions, DocumentsGoToStandardOutput) {
    ASSERT_EQ(run("print -o a.pdf --paper 60x60 --origin 5,6"), 0);
    ASSERT_EQ(shell("TMPDIR=$PWD \"$T\" print -o - --format pdf --paper 60x60 --origin 5,6"), 0)
        << errors_;
    EXPECT_THAT(output_, StartsWith("%PDF"));
    EXPECT_THAT(output_, EndsWith("%%EOF\n"));
    EXPECT_THAT(errors_, StartsWith("-: page 60 x 60 mm, cells 5,6 to "));
    ASSERT_EQ(shell("TMPDIR=$PWD \"$T\" overlay a.pdf -o - --origin 7,8"), 0) << errors_;
    EXPECT_THAT(output_, StartsWith("%PDF"));
    EXPECT_THAT(errors_, StartsWith("- 1: page 60 x 60 mm, cells 7,8 to "));
    for (const std::string format : {"png", "svg", "tif", "txt"}) {
        ASSERT_EQ(run("print -o a." + format + " --paper 30x30 --spacing 1"), 0);
        ASSERT_EQ(run("print -o - --format " + format + " --paper 30x30 --spacing 1"), 0);
        EXPECT_EQ(output_, file("a." + format));
    }
    expect_files("a.pdf a.png a.svg a.tif a.txt run.csv ");
}

TEST_F(Conventions, DocumentsGetIntoASheetFileThoughTheyGoToStandardOutput) {
    ASSERT_EQ(run("print -o - --format svg --paper 60x60 --sheets sheets.json --name a"), 0);
    EXPECT_THAT(output_, HasSubstr("</svg>"));
    EXPECT_THAT(errors_, HasSubstr(", sheet 'a' of sheets.json"));
    EXPECT_THAT(file("sheets.json"), HasSubstr("\"name\": \"a\""));
    EXPECT_THAT(file("sheets.json"), Not(HasSubstr("reserved")));
    ASSERT_EQ(run("sheets place a --x 0 --y 0 --yaw 0"), 0) << errors_;
    ASSERT_EQ(run("sheets map -o map.svg"), 0) << errors_;
    ASSERT_EQ(run("sheets map -o -"), 0) << errors_;
    EXPECT_EQ(output_, file("map.svg"));
}

TEST_F(Conventions, FormatOfADocumentFitsItsName) {
    EXPECT_EQ(run("print -o -"), 2);
    EXPECT_THAT(errors_, StartsWith("dotpose: -o - needs --format: pdf, svg, png, tif or txt\n"));
    EXPECT_EQ(run("print -o a.svg --format pdf"), 2);
    EXPECT_THAT(errors_, HasSubstr("--format pdf: the name a.svg is that of another format"));
    EXPECT_EQ(run("print -o a.tiff --format tif --paper 30x30"), 0) << errors_;
}

TEST_F(Conventions, LinesAndReportsGoToStandardOutput) {
    put_frame();
    for (const std::string command :
         {"locate a.pgm --format csv | sed 's/[0-9.]*,anoto,/,anoto,/'", "replay run.csv",
          "replay run.csv --format json", "evaluate --preset clean --frames 2 --format json",
          "check-print a.pgm --dpi 100"}) {
        const auto without_time = [](const std::string& text) {
            return text.substr(0, text.find("elapsed"));
        };
        run(command);
        const std::string expected = without_time(output_);
        EXPECT_THAT(expected, Not(IsEmpty())) << command << errors_;
        const std::size_t pipe = command.find(" |");
        const std::string begin = command.substr(0, pipe);
        const std::string end = pipe == std::string::npos ? "" : command.substr(pipe);
        run(begin + " -o -" + end);
        EXPECT_EQ(without_time(output_), expected) << command;
        run(begin + " -o result" + end);
        EXPECT_EQ(without_time(file("result")).size(),
                  end.empty() ? expected.size() : without_time(file("result")).size());
        EXPECT_THAT(file("result"), Not(IsEmpty())) << command;
    }
    expect_files("a.pgm result run.csv ");
}

TEST_F(Conventions, ACameraFileGoesToStandardOutput) {
    ASSERT_EQ(run("simulate -o frames --frames 6 --preset clean --seed 3 --tilt 0,0"), 0);
    ASSERT_EQ(run("calibrate frames/*.pgm -o camera.yaml"), 0) << errors_;
    const std::string report = output_;
    ASSERT_EQ(run("calibrate frames/*.pgm -o -"), 0) << errors_;
    EXPECT_EQ(output_, file("camera.yaml"));
    EXPECT_EQ(errors_, report);
}

TEST_F(Conventions, OnlyOIsStandardOutput) {
    for (const std::string command :
         {"replay run.csv --draw -", "watch - --size 8x8 --log -", "watch - --size 8x8 --draw -"}) {
        EXPECT_EQ(run(command), 2) << command;
        EXPECT_THAT(errors_, HasSubstr("only -o takes - for standard output")) << command;
    }
    EXPECT_EQ(run("simulate -o -"), 2);
    EXPECT_EQ(run("evaluate --sweep noise -o -"), 2);
    expect_files("run.csv ");
}

}  // namespace
}  // namespace dotpose::test

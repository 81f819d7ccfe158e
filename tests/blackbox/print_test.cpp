// Black-box tests of `dotpose print`.
#include <cstdint>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

class PrintCommand : public ToolCommand {
  protected:
    bool is_empty() const { return fs::is_empty(directory_); }
};

TEST_F(PrintCommand, writes_a_sheet_and_says_what_is_on_it) {
    run("print -o sheet.txt");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(errors_, IsEmpty());
    EXPECT_EQ(output_,
              "sheet.txt: page 210 x 297 mm, cells 0,0 to 393,564 (394 x 565), spacing 0.508 mm, "
              "section 0,0, code anoto\n");
    EXPECT_THAT(file("sheet.txt"), StartsWith("uulluldu"));
    EXPECT_EQ(file("sheet.txt").size(), 395U * 565U);
}

TEST_F(PrintCommand, takes_all_options) {
    run("print --out sheet.txt --paper 30x20 --landscape --margin 2 --spacing 1 --dot 0.2 "
        "--displacement 0.1 --origin 7,3 --section 10,2 --code microdots --dpi 1200");
    EXPECT_EQ(exit_code_, 0) << errors_;
    EXPECT_EQ(output_,
              "sheet.txt: page 30 x 20 mm, cells 7,3 to 32,18 (26 x 16), spacing 1 mm, section "
              "10,2, code microdots\n");
    EXPECT_THAT(file("sheet.txt"), StartsWith("drurrdll"));
}

TEST_F(PrintCommand, writes_every_format) {
    EXPECT_EQ(run("print --paper 20x20 -o a.svg"), 0);
    EXPECT_THAT(file("a.svg"), HasSubstr("width=\"20mm\""));
    run("print --paper 20x20 -o a.png --dpi 300");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr(", 300 dpi\n"));
    EXPECT_THAT(file("a.png"), StartsWith("\x89PNG"));
    EXPECT_EQ(run("print --paper 20x20 -o a.tif"), 0);
    EXPECT_THAT(file("a.tif").substr(0, 2), testing::AnyOf("II", "MM"));
}

/// Returns the 32-bit big-endian number at an offset, as used in PNG.
std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = at; i < at + 4; ++i)
        number = number << 8 | static_cast<unsigned char>(bytes.at(i));
    return number;
}

TEST_F(PrintCommand, images_carry_the_resolution_asked_for) {
    struct Case {
        const char* option;
        std::uint32_t dpi;
        std::uint32_t per_metre;  ///< dpi / 0.0254, rounded to the nearest integer
    };
    for (const auto& [option, dpi, per_metre] :
         {Case{"--dpi 300", 300, 11811}, {"", 600, 23622}, {"--dpi 1200", 1200, 47244}}) {
        // The page measures 1 x 2 inches, so its width in pixels equals the resolution in dpi.
        ASSERT_EQ(run(std::string("print --paper 25.4x50.8 -o a.png ") + option), 0);
        const std::string png = file("a.png");
        EXPECT_EQ(number_at(png, 16), dpi);
        EXPECT_EQ(number_at(png, 20), 2 * dpi);
        EXPECT_EQ(png.at(24), 1) << "bits per sample";
        EXPECT_EQ(png.at(25), 0) << "grey";
        const std::size_t physical = png.find("pHYs");
        ASSERT_NE(physical, std::string::npos);
        EXPECT_EQ(number_at(png, physical + 4), per_metre);
        EXPECT_EQ(number_at(png, physical + 8), per_metre);
        EXPECT_EQ(png.at(physical + 12), 1) << "the unit is the metre";

        ASSERT_EQ(run(std::string("print --paper 25.4x50.8 -o a.tif ") + option), 0);
        TIFF* tiff = TIFFOpen((directory_ / "a.tif").c_str(), "r");
        ASSERT_NE(tiff, nullptr);
        std::uint32_t width = 0;
        std::uint16_t bits = 0;
        std::uint16_t unit = 0;
        float x_dpi = 0;
        float y_dpi = 0;
        TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
        TIFFGetField(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
        TIFFGetField(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
        TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x_dpi);
        TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y_dpi);
        TIFFClose(tiff);
        EXPECT_EQ(width, dpi);
        EXPECT_EQ(bits, 1);
        EXPECT_EQ(unit, RESUNIT_INCH);
        EXPECT_EQ(x_dpi, static_cast<float>(dpi));
        EXPECT_EQ(y_dpi, static_cast<float>(dpi));
    }
}

TEST_F(PrintCommand, wrong_usage_is_status_2_with_one_message_and_no_file) {
    const char* const wrong[] = {
        "",                                  // no --out
        "-o a.jpg",                          // unknown format
        "-o a.png --paper A9",               // unknown paper
        "-o a.png --margin 200",             // no room for dots
        "-o a.png --spacing 0",              // not a length
        "-o a.png --spacing -1",             //
        "-o a.png --spacing nan",            //
        "-o a.png --spacing 0.5 --dot 0.4",  // dots touch
        "-o a.png --origin 1",               // only one coordinate
        "-o a.png --origin 1,2,3",           //
        "-o a.png --origin -1,2",            //
        "-o a.png --origin 410815348,0",     // outside the plane
        "-o a.png --origin 410815000,0",     // extends past the end of the plane
        "-o a.png --section 63,0",           // no such section
        "-o a.png --code 1",                 // not a name
        "-o a.png --dpi 100",                // too coarse for the displacement
        "-o a.png --bogus",                  //
        "-o a.png stray",                    //
    };
    for (const char* arguments : wrong) {
        run(std::string("print ") + arguments);
        EXPECT_EQ(exit_code_, 2) << arguments;
        EXPECT_THAT(errors_, StartsWith("dotpose: ")) << arguments;
        EXPECT_THAT(output_, IsEmpty()) << arguments;
        EXPECT_TRUE(is_empty()) << arguments;
    }
}

TEST_F(PrintCommand, a_file_that_cannot_be_written_is_status_1) {
    run("print -o missing/a.png");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(errors_, "dotpose: cannot create missing/a.png: No such file or directory\n");
    EXPECT_THAT(output_, IsEmpty());
}

TEST_F(PrintCommand, a_signal_leaves_no_litter) {
    // Printing this page takes minutes, so the signal arrives before the page is complete.
    run("print -o huge.png --paper 20000x20000 --dpi 1200 & tool=$!; "
        "until ls -A | grep -c huge || ! kill -0 $tool; do sleep 0.02; done > count; "
        "tail -n 1 count; rm count; kill $tool; wait $tool");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(output_, "1\n") << "the temporary file should have been there";
    EXPECT_EQ(errors_, "dotpose: stopped; nothing was written\n");
    EXPECT_TRUE(is_empty());
}

TEST_F(PrintCommand, help_shows_an_example) {
    run("print --help");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr("dotpose print -o sheet.svg"));
    for (const char* option :
         {"--out", "--paper", "--landscape", "--margin", "--spacing", "--dot", "--displacement",
          "--origin", "--section", "--code", "--dpi", "--sheets", "--name"}) {
        EXPECT_THAT(output_, HasSubstr(option));
    }
}

TEST_F(PrintCommand, version_is_printed) {
    run("--version");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, MatchesRegex("dotpose [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace dotpose::test

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <tiffio.h>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

struct Outcome {
    int exit_code = -1;
    std::string output;  ///< standard output
    std::string errors;  ///< standard error
};

std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Runs `dotpose ARGUMENTS` in a directory of its own.
class PrintCommand : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "dotpose-tool-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { fs::remove_all(directory_); }

    Outcome run(const std::string& arguments) {
        const std::string errors = (directory_ / "stderr").string();
        const std::string command = "cd '" + directory_.string() + "' && { '" DOTPOSE_TOOL "' " +
                                    arguments + "; } 2>'" + errors + "'";
        Outcome outcome;
        std::FILE* pipe = popen(command.c_str(), "r");
        if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
        std::array<char, 4096> buffer;
        while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
            outcome.output += buffer.data();
        }
        const int status = pclose(pipe);
        if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
        outcome.errors = read_file(errors);
        fs::remove(errors);
        return outcome;
    }

    std::string content(const char* name) const { return read_file(directory_ / name); }
    bool is_empty() const { return fs::is_empty(directory_); }

    fs::path directory_;
};

TEST_F(PrintCommand, writes_a_sheet_and_says_what_is_on_it) {
    const Outcome outcome = run("print -o sheet.txt");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.errors, IsEmpty());
    EXPECT_EQ(outcome.output,
              "sheet.txt: page 210 x 297 mm, cells 0,0 to 393,564 (394 x 565), spacing 0.508 mm, "
              "section 0,0, code anoto\n");
    EXPECT_THAT(content("sheet.txt"), StartsWith("uulluldu"));
    EXPECT_EQ(content("sheet.txt").size(), 395U * 565U);
}

TEST_F(PrintCommand, takes_all_options) {
    const Outcome outcome =
        run("print --out sheet.txt --paper 30x20 --landscape --margin 2 --spacing 1 --dot 0.2 "
            "--displacement 0.1 --origin 7,3 --section 10,2 --code microdots --dpi 1200");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output,
              "sheet.txt: page 30 x 20 mm, cells 7,3 to 32,18 (26 x 16), spacing 1 mm, section "
              "10,2, code microdots\n");
    EXPECT_THAT(content("sheet.txt"), StartsWith("drurrdll"));
}

TEST_F(PrintCommand, writes_every_format) {
    EXPECT_EQ(run("print --paper 20x20 -o a.svg").exit_code, 0);
    EXPECT_THAT(content("a.svg"), HasSubstr("width=\"20mm\""));
    const Outcome png = run("print --paper 20x20 -o a.png --dpi 300");
    EXPECT_EQ(png.exit_code, 0);
    EXPECT_THAT(png.output, HasSubstr(", 300 dpi\n"));
    EXPECT_THAT(content("a.png"), StartsWith("\x89PNG"));
    EXPECT_EQ(run("print --paper 20x20 -o a.tif").exit_code, 0);
    EXPECT_THAT(content("a.tif").substr(0, 2), testing::AnyOf("II", "MM"));
}

/// Four bytes, the highest first, as PNG has them.
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
        std::uint32_t per_metre;  ///< dpi / 0.0254, to the nearest
    };
    for (const auto& [option, dpi, per_metre] :
         {Case{"--dpi 300", 300, 11811}, {"", 600, 23622}, {"--dpi 1200", 1200, 47244}}) {
        // A page of 1 x 2 inches.
        ASSERT_EQ(run(std::string("print --paper 25.4x50.8 -o a.png ") + option).exit_code, 0);
        const std::string png = content("a.png");
        EXPECT_EQ(number_at(png, 16), dpi);
        EXPECT_EQ(number_at(png, 20), 2 * dpi);
        EXPECT_EQ(png.at(24), 1) << "bits per sample";
        EXPECT_EQ(png.at(25), 0) << "grey";
        const std::size_t physical = png.find("pHYs");
        ASSERT_NE(physical, std::string::npos);
        EXPECT_EQ(number_at(png, physical + 4), per_metre);
        EXPECT_EQ(number_at(png, physical + 8), per_metre);
        EXPECT_EQ(png.at(physical + 12), 1) << "the unit is the metre";

        ASSERT_EQ(run(std::string("print --paper 25.4x50.8 -o a.tif ") + option).exit_code, 0);
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
        "-o a.png --margin 200",             // no room
        "-o a.png --spacing 0",              // no length
        "-o a.png --spacing -1",             //
        "-o a.png --spacing nan",            //
        "-o a.png --spacing 0.5 --dot 0.4",  // dots touch
        "-o a.png --origin 1",               // half a cell
        "-o a.png --origin 1,2,3",           //
        "-o a.png --origin -1,2",            //
        "-o a.png --origin 410815348,0",     // outside the plane
        "-o a.png --origin 410815000,0",     // runs past its end
        "-o a.png --section 63,0",           // no such section
        "-o a.png --code 1",                 // not a name
        "-o a.png --dpi 100",                // displacement not visible
        "-o a.png --bogus",                  //
        "-o a.png stray",                    //
    };
    for (const char* arguments : wrong) {
        const Outcome outcome = run(std::string("print ") + arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments;
        EXPECT_THAT(outcome.errors, StartsWith("dotpose: ")) << arguments;
        EXPECT_THAT(outcome.output, IsEmpty()) << arguments;
        EXPECT_TRUE(is_empty()) << arguments;
    }
}

TEST_F(PrintCommand, a_file_that_cannot_be_written_is_status_1) {
    const Outcome outcome = run("print -o missing/a.png");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.errors, "dotpose: cannot create missing/a.png: No such file or directory\n");
    EXPECT_THAT(outcome.output, IsEmpty());
}

TEST_F(PrintCommand, a_signal_leaves_no_litter) {
    // A page that would take minutes.
    const Outcome outcome = run(
        "print -o huge.png --paper 20000x20000 --dpi 1200 & tool=$!; sleep 0.5; ls -A | grep -c "
        "huge; kill $tool; wait $tool");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.output, "1\n") << "the temporary file should have been there";
    EXPECT_EQ(outcome.errors, "dotpose: stopped; nothing was written\n");
    EXPECT_TRUE(is_empty());
}

TEST_F(PrintCommand, help_shows_an_example) {
    const Outcome outcome = run("print --help");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, HasSubstr("dotpose print -o sheet.svg"));
    for (const char* option :
         {"--out", "--paper", "--landscape", "--margin", "--spacing", "--dot", "--displacement",
          "--origin", "--section", "--code", "--dpi", "--sheets", "--name"}) {
        EXPECT_THAT(outcome.output, HasSubstr(option));
    }
}

TEST_F(PrintCommand, version_is_printed) {
    const Outcome outcome = run("--version");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, MatchesRegex("dotpose [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace

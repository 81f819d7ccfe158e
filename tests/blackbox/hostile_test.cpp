// Tests malicious input: names and files designed to do harm.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Hostile : public ToolCommand {
  protected:
    void put(const std::string& name, const std::string& text) {
        std::ofstream(directory_ / name, std::ios::binary) << text;
    }
    void simulate(int frames = 1) {
        ASSERT_EQ(run("simulate -o frames --frames " + std::to_string(frames)), 0);
    }
};

/// Control sequences that set the title and the colour of a terminal and ring its bell, followed by
/// a line break and a forged output line.
constexpr const char* kActs = "\x1b]0;OWNED\x07\x1b[31m\x7f\xc2\x9b\n{\"status\":\"ok\"}";

void expect_harmless(const std::string& text) {
    for (const unsigned char c : text)
        EXPECT_TRUE(c >= ' ' || c == '\n') << static_cast<int>(c) << " in " << text;
    EXPECT_THAT(text, Not(HasSubstr("\x7f")));
    EXPECT_THAT(text, Not(HasSubstr("\xc2\x9b")));
}

TEST_F(Hostile, FileNamesDoNotActOnTheTerminal) {
    simulate();
    const std::string name = std::string("evil") + kActs + ".pgm";
    fs::rename(directory_ / "frames/frame_000000.pgm", directory_ / name);
    put(std::string("none") + kActs + ".pgm", "P5 none");
    for (const char* format : {"json", "csv"}) {
        run(std::string("locate --format ") + format + " evil* none*");
        expect_harmless(output_);
        expect_harmless(errors_);
        EXPECT_EQ(std::ranges::count(output_, '\n'), std::string(format) == "csv" ? 2 : 1);
        EXPECT_EQ(std::ranges::count(errors_, '\n'), 1);
    }
    run("check-print none*");
    expect_harmless(errors_);
    run("replay \"$(ls -d none*)\"");
    expect_harmless(errors_);
    EXPECT_EQ(run("print -o \"a$(printf '\\033[31m').txt\" --paper 40x40"), 0);
    expect_harmless(output_);
}

TEST_F(Hostile, OptionsRefuseWhatIsNoFiniteNumber) {
    const char* const kCommands[] = {
        "watch frames --max-speed nan",   "watch frames --fps nan",
        "watch frames --max-p-wrong nan", "watch frames --lost-after nan",
        "watch frames --mqtt-rate nan",   "watch frames --exposure inf",
        "watch frames --gain -inf",       "watch frames --acceleration nan",
        "print -o a.txt --margin nan",    "optics --mm-per-px infinity",
        "simulate -o b --angle nan",      "fleet --mqtt mqtt://localhost --seconds nan",
    };
    for (const char* command : kCommands) {
        EXPECT_EQ(run(command), 2) << command;
        EXPECT_THAT(errors_, HasSubstr("finite number")) << command;
    }
    // The file name `nan` could also be parsed as a number.
    put("nan", "P5 1 1 255\nx");
    run("locate nan");
    EXPECT_THAT(output_, HasSubstr("\"file\":\"nan\""));
}

TEST_F(Hostile, SizesDoNotWrapAround) {
    for (const char* size : {"4294967297x1", "100000x100000", "0x5", "-1x5", "5x", "5x5x5", "x"}) {
        EXPECT_EQ(run(std::string("watch - --fps 5 --size ") + size), 2) << size;
        EXPECT_THAT(errors_, HasSubstr("--size")) << size;
        EXPECT_EQ(run(std::string("simulate -o a --size ") + size), 2) << size;
    }
    EXPECT_EQ(run("watch - --fps 5 --size 640x480 --roi 4294967296,0,10x10"), 2);
}

TEST_F(Hostile, NestingAndSizeOfTextFilesAreBounded) {
    simulate();
    const std::string deep = std::string(1'000'000, '[');
    put("format.json", "{\"format\":" + deep);
    put("key.json", "{\"format\":\"dotpose-sheets\",\"version\":1,\"x\":" + deep);
    for (const char* file : {"format.json", "key.json"}) {
        EXPECT_EQ(run(std::string("locate frames/* --sheets ") + file), 1);
        EXPECT_THAT(errors_, HasSubstr("is nested deeper than 64 levels"));
        EXPECT_EQ(run(std::string("print -o a.txt --name a --sheets ") + file), 1);
        EXPECT_THAT(errors_, HasSubstr("is nested deeper than 64 levels"));
    }
    put("deep.yaml", "format: " + std::string(100'000, '['));
    EXPECT_EQ(run("locate frames/* --camera deep.yaml"), 1);
    expect_harmless(errors_);
    EXPECT_EQ(run("locate frames/* --sheets /dev/zero"), 1);
    EXPECT_THAT(errors_, HasSubstr("/dev/zero has more than 64 MB"));
    EXPECT_EQ(run("locate frames/* --camera /dev/zero"), 1);
    EXPECT_THAT(errors_, HasSubstr("/dev/zero has more than 1 MB"));
}

/// Returns the beginning of a PNG file of 16,000 x 16,000 px, without the pixel data.
std::string png_header() {
    using namespace std::string_literals;
    return "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x3e\x80\0\0\x3e\x80\x08\0\0\0\0\x64\x15\x80\x02"
           "\0\0\x10\0IDAT"s +
           std::string(100, '\0');
}

TEST_F(Hostile, TheHeaderOfAnImageIsLookedAtFirst) {
    put("bomb.png", png_header());
    put("bomb.pgm", "P5 16000 16000 255\n");
    for (const char* bomb : {"bomb.png", "bomb.pgm"}) {
        EXPECT_EQ(run(std::string("locate ") + bomb), 0);
        EXPECT_THAT(output_,
                    HasSubstr("\"status\":\"image_too_large\",\"message\":\"the image is 16000 "
                              "x 16000 px; at most 100 million px are read\""));
        EXPECT_EQ(run(std::string("check-print --dpi 600 ") + bomb), 1);
        EXPECT_THAT(errors_, HasSubstr("the image is too large: 16000 x 16000 px; at most 100 "
                                       "million px are read; --max-pixels 256 reads it, which "
                                       "takes 2.3 GB of memory; 300 dpi instead of 600 suffice"));
        EXPECT_EQ(run(std::string("check-print --dpi 1200 ") + bomb), 1);
        EXPECT_THAT(errors_, HasSubstr("; 600 dpi instead of 1200 suffice"));
        EXPECT_EQ(run(std::string("check-print --dpi 600 --max-pixels 256 ") + bomb), 1);
        EXPECT_THAT(errors_, Not(HasSubstr("too large")));
    }
    EXPECT_EQ(run("check-print --max-pixels 269 bomb.png"), 2);
}

TEST_F(Hostile, EndlessFilesAreRefused) {
    EXPECT_EQ(shell("{ printf 'P5 64 64 255\\n'; cat /dev/zero; } | \"$T\" locate /dev/stdin"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot read /dev/stdin: the file is larger than an image of "
                                   "100 million px takes"));
    EXPECT_EQ(run("locate /dev/zero"), 1);
    EXPECT_THAT(errors_, HasSubstr("not a PNM, PNG"));
    EXPECT_EQ(run("locate --list /dev/zero"), 1);
    EXPECT_THAT(errors_, HasSubstr("the list /dev/zero: a line has more than 64 KB"));
    EXPECT_EQ(run("replay /dev/zero"), 1);
    EXPECT_THAT(errors_,
                HasSubstr("/dev/zero:1: not a log of dotpose watch: a line has more than 64 KB"));
    put("run.csv", "frame,t_s\n" + std::string(100'000, '1'));
    EXPECT_EQ(run("replay run.csv"), 1);
}

TEST_F(Hostile, AbsurdCamerasAreRefused) {
    simulate();
    const std::string native =
        "format: dotpose-camera\nversion: 1\nwidth_px: 188\nheight_px: 120\nk_per_px2: 1e-7\n"
        "centre_px: [93.5, 59.5]\n";
    const std::string ros =
        "image_width: 188\nimage_height: 120\ndistortion_model: plumb_bob\n"
        "camera_matrix: {rows: 3, cols: 3, data: [";
    const struct {
        std::string text;
        const char* message;
    } kCases[] = {
        {native + "mm_per_px: [0.046, 0.046]\nperspective_per_px: [-1, -1]\n",
         "perspective_per_px puts the horizon into the image"},
        {native + "mm_per_px: [1e308, 1e308]\n", "mm_per_px must be from"},
        {native + "focal_px: 1e300\n", "focal_px must be from 1 to"},
        {ros + "1e-300,0,1e-300,0,1e-300,1e-300,0,0,1]}\ndistortion_coefficients: {data: "
               "[0.01,0,0,0,0]}\n",
         "camera_matrix has focal lengths, or a centre, that no camera has"},
        {ros + "300,0,93,0,300,59,0,0,1]}\ndistortion_coefficients: {data: [1e300,0,0,0,0]}\n",
         "distortion_coefficients are larger than those of any lens"},
        {ros + "300,0,93,0,300,59,0,0,1]}\ndistortion_coefficients: {data: [-900,0,0,0,900]}\n",
         "distortion_coefficients describe a lens that one coefficient cannot represent"},
    };
    for (const auto& [text, message] : kCases) {
        put("camera.yaml", text);
        EXPECT_EQ(run("locate frames/* --camera camera.yaml"), 1) << text;
        EXPECT_THAT(errors_, HasSubstr(message));
        EXPECT_EQ(std::ranges::count(errors_, '\n'), 1) << errors_;
    }
}

TEST_F(Hostile, AbsurdNumbersOfALogAreRefused) {
    const std::string header =
        "frame,t_s,status,dots_seen,p_wrong,state,events,verdict,plane,track_x_mm,track_y_mm,"
        "vx_mm_s,vy_mm_s\n";
    for (const char* row : {"1e300,0,ok,1,,,,,,,,,", "-1,0,ok,1,,,,,,,,,", "0.5,0,ok,1,,,,,,,,,",
                            "1,0,ok,1e300,,,,,,,,,", "nan,0,ok,1,,,,,,,,,"}) {
        put("run.csv", header + row + "\n");
        EXPECT_EQ(run("replay run.csv"), 1) << row;
        EXPECT_THAT(errors_, HasSubstr("run.csv:2: not a log of dotpose watch")) << row;
    }
}

TEST_F(Hostile, AMapThatCannotBeWrittenIsToldBeforeTheRun) {
    simulate(3);
    EXPECT_EQ(run("watch frames --draw /nonexistent/x.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot create /nonexistent/x.svg: No such file or directory"));
    EXPECT_EQ(output_, "");
    EXPECT_EQ(run("watch frames --record /nonexistent/x.mp4"), 1);
    EXPECT_EQ(output_, "");
    EXPECT_EQ(run("fleet --mqtt mqtt://127.0.0.1:1 --draw /nonexistent/x.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot create /nonexistent/x.svg"));
}

TEST_F(Hostile, AReaderThatLeavesEndsNeitherMapNorLog) {
    simulate(40);
    EXPECT_EQ(shell("\"$T\" watch frames --draw map.svg --log log.csv | head -n 1"), 0);
    EXPECT_EQ(std::ranges::count(output_, '\n'), 1);
    EXPECT_EQ(std::ranges::count(file("log.csv"), '\n'), 41);
    EXPECT_THAT(file("map.svg"), HasSubstr("40 frames"));
    // The frames are sent only after the reader of the packets has closed the pipe.
    EXPECT_EQ(shell("mkfifo packets; (exec 3< packets; exec 3<&-; : > left) & "
                    "(until [ -e left ]; do sleep 0.01; done; tail -q -c 22560 frames/*.pgm) |"
                    "\"$T\" watch - --size 188x120 --packets packets -o lines; wait"),
              0);
    EXPECT_THAT(errors_, HasSubstr("cannot write packets: Broken pipe"));
    EXPECT_EQ(std::ranges::count(file("lines"), '\n'), 40);
}

TEST_F(Hostile, AFullDiskIsToldByTheRecording) {
    simulate(40);
    // `ulimit` limits the size of files to 8 blocks of 512 bytes. `trap` makes the program ignore
    // the signal that would otherwise end it when a file reaches this limit.
    EXPECT_EQ(shell("trap '' XFSZ; ulimit -f 8; \"$T\" watch frames --fps 50 --record a.mp4 | cat"
                    " > /dev/null; \"$T\" watch frames --fps 50 --record a.mp4 > /dev/null"),
              1);
    EXPECT_THAT(errors_, HasSubstr("cannot record to a.mp4: File too large"));
}

}  // namespace
}  // namespace dotpose::test

// Checks that no command destroys any of its inputs, regardless of the names of its outputs.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class RunFiles : public ToolCommand {
  protected:
    void SetUp() override {
        ASSERT_EQ(run("simulate -o g --frames 3 --seed 1"), 0) << errors_;
        ASSERT_EQ(run("print -o page.svg --paper 40x40 --sheets s.json --name a"), 0) << errors_;
        write("c.yaml",
              "{format: dotpose-camera, version: 1, width_px: 188, height_px: 120, k_per_px2: 0, "
              "centre_px: [93.5, 59.5]}");
        write("l", "g/frame_000000.pgm\ng/frame_000001.pgm\n");
        ASSERT_EQ(shell("$T watch g --no-window --log run.csv --packets p.bin >/dev/null && "
                        "cp p.bin d.mp4 && $T print -o form.pdf --paper 40x40 && "
                        "ln -s s.json soft.json && ln s.json hard.json && ln -s new.csv to-new"),
                  0)
            << errors_;
    }

    void write(const std::string& name, const std::string& text) {
        std::ofstream(directory_ / name, std::ios::binary) << text;
    }

    /// Returns the names, types, inodes and checksums of all files in the directory.
    std::string state() {
        shell("find . -printf '%p %y %i\\n' | sort; find . -type f -exec cksum {} + | sort");
        return output_;
    }

    struct Refusal {
        std::string command;
        std::string reason;
    };

    /// Expects that each command is refused for the given reason and changes no file.
    void expect_refused(const std::vector<Refusal>& refusals) {
        const std::string before = state();
        for (const auto& [command, reason] : refusals) {
            EXPECT_EQ(run(command), 2) << command;
            EXPECT_THAT(errors_, HasSubstr(reason)) << command;
        }
        EXPECT_EQ(state(), before);
    }
    void expect_refused(const std::vector<std::string>& commands, const std::string& reason) {
        std::vector<Refusal> refusals;
        for (const std::string& command : commands)
            refusals.push_back({command, reason});
        expect_refused(refusals);
    }
};

TEST_F(RunFiles, no_output_is_an_input) {
    const std::vector<std::string> commands = {
        "locate --sheets s.json g/frame_000000.pgm -o s.json",
        "locate --sheets s.json g/frame_000000.pgm -o ./g/../s.json",
        "locate --sheets s.json g/frame_000000.pgm -o soft.json",
        "locate --sheets soft.json g/frame_000000.pgm -o hard.json",
        "locate --camera c.yaml g/frame_000000.pgm -o c.yaml",
        "locate --list l -o l",
        "locate --list - -o l <l",
        "watch g --no-window --sheets s.json --log hard.json",
        "watch g --no-window --sheets s.json --draw soft.json",
        "watch d.mp4 --no-window --record d.mp4",
        "watch g --no-window --mqtt mqtt://localhost:1 --mqtt-ca c.yaml --log c.yaml",
        "fleet --mqtt mqtt://localhost:1 --sheets s.json --draw s.json --seconds 1",
        "replay run.csv -o run.csv",
        "listen p.bin -o p.bin",
        "listen - -o p.bin <p.bin",
        "overlay form.pdf -o ./form.pdf",
        "check-print page.svg --draw page.svg",
        "check-print g/frame_000000.pgm --sheets page.svg --draw page.svg",
        "calibrate g/frame_000000.pgm --camera c.yaml --draw c.yaml",
        "calibrate l -o l",
        "calibrate --spin l -o l",
        "calibrate --drive l --camera c.yaml -o l",
    };
    expect_refused(commands, " would overwrite the input ");
}

TEST_F(RunFiles, no_two_outputs_are_one_file) {
    const std::vector<std::string> commands = {
        "print -o st.txt --paper 40x40 --sheets st.txt --name a",
        "watch g --no-window -o a.csv --log ./a.csv",
        "watch g --no-window --log new.csv --draw to-new",
        "watch g --no-window --log a.csv --packets A.CSV",
        "calibrate g/frame_000000.pgm -o a.yaml --draw a.yaml",
        "calibrate --stitch --sheets s.json g/frame_000000.pgm --draw s.json",
    };
    expect_refused(commands, "name another");
}

TEST_F(RunFiles, text_and_drawings_are_not_written_to_names_of_images) {
    expect_refused({
        {"locate -o g/*.pgm", "would contain JSON"},
        {"locate --format csv -o g/*.pgm", "would contain CSV"},
        {"locate -o new.PNG g/frame_000000.pgm", "would contain JSON"},
        {"calibrate -o g/*.pgm", "would contain YAML"},
        {"calibrate g/*.pgm --draw g/frame_000000.pgm", "would contain an SVG picture"},
        {"watch g --no-window --log d.mp4", "would contain CSV"},
        {"watch g --no-window --draw new.png", "would contain an SVG picture"},
        {"watch g --no-window --packets new.jpeg", "would contain pose packets"},
        {"listen p.bin -o g/frame_000000.pgm", "would contain JSON"},
        {"replay run.csv -o new.tiff", "would contain a report"},
        {"replay run.csv --format json -o new.tiff", "would contain JSON"},
        {"replay run.csv --draw new.tiff", "would contain an SVG picture"},
        {"print -o new.svg --paper 40x40 --sheets new.png --name a", "would contain JSON"},
    });
}

TEST_F(RunFiles, a_camera_file_may_be_completed_but_not_turned_into_another_format) {
    write(
        "ros.yaml",
        "{image_width: 188, image_height: 120, distortion_model: plumb_bob, camera_matrix: {rows: "
        "3, cols: 3, data: [300, 0, 93.5, 0, 300, 59.5, 0, 0, 1]}, distortion_coefficients: {rows: "
        "1, cols: 5, data: [0, 0, 0, 0, 0]}}");
    expect_refused({"calibrate --camera ros.yaml --drive g/frame_000000.pgm -o ros.yaml"},
                   " would overwrite the input ");
    // The output replaces one of the inputs, which is allowed here. The command fails later,
    // because three frames at random positions do not form a drive.
    EXPECT_EQ(run("calibrate --camera c.yaml --drive g/*.pgm -o c.yaml"), 1);
}

TEST_F(RunFiles, other_names_are_taken_as_before) {
    EXPECT_EQ(run("locate --list l -o poses.jsonl"), 0) << errors_;
    EXPECT_EQ(run("locate --list l -o poses.jsonl"), 0) << errors_;
    EXPECT_EQ(run("locate --list - -o /dev/null <l"), 0) << errors_;
    EXPECT_EQ(run("watch g --no-window -o /dev/null --log /dev/null --packets /dev/null"), 0)
        << errors_;
    EXPECT_EQ(run("print -o page.svg --paper 40x40 --sheets soft.json --name b"), 0) << errors_;
}

TEST_F(RunFiles, pictures_of_frames_are_outputs_too) {
    // The list file has the same path as one of the pictures that `--draw` would write.
    ASSERT_EQ(shell("mkdir p; mv l p/frame_000000.svg"), 0);
    const std::string list = file("p/frame_000000.svg");
    EXPECT_EQ(run("locate --list p/frame_000000.svg --draw p"), 1);
    EXPECT_THAT(errors_, HasSubstr("would overwrite the input --list p/frame_000000.svg"));
    EXPECT_EQ(file("p/frame_000000.svg"), list);
    EXPECT_TRUE(fs::exists(directory_ / "p/frame_000001.svg"));
    // Names that differ only in case are different names, so neither picture overwrites the other.
    ASSERT_EQ(shell("cp g/frame_000000.pgm a.pgm && cp g/frame_000001.pgm A.pgm"), 0);
    EXPECT_EQ(run("locate a.pgm A.pgm --draw p"), 0) << errors_;
}

}  // namespace
}  // namespace dotpose::test

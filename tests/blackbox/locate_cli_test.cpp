#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../xml_check.hpp"
#include "csv_columns.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(LocateCommand, finds_the_true_poses) {
    constexpr std::uint64_t kFrames = 12;
    std::string names;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        const std::string name = std::to_string(i) + ".pgm";
        write_frame(name, i);
        names += " " + name;
    }
    run("--code anoto" + names);
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(errors_, IsEmpty());
    const std::vector<json> found = records();
    ASSERT_EQ(found.size(), kFrames);
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        const Shot truth = shot(i);
        const json& record = found[i];
        EXPECT_EQ(record["file"], std::to_string(i) + ".pgm");
        ASSERT_EQ(record["status"], "ok");
        EXPECT_FALSE(record.contains("message"));
        EXPECT_NEAR(record["x_grid"], x_grid(truth.pose), 0.03);
        EXPECT_NEAR(record["y_grid"], y_grid(truth.pose), 0.03);
        EXPECT_NEAR(record["x_mm"], x_grid(truth.pose) * 0.508, 0.015);
        EXPECT_NEAR(record["y_mm"], y_grid(truth.pose) * 0.508, 0.015);
        const double theta_deg = truth.pose.theta_rad * 180 / 3.14159265358979;
        EXPECT_NEAR(std::remainder(record["theta_deg"].get<double>() - theta_deg, 360), 0, 0.3);
        EXPECT_GT(record["theta_deg"], -180);
        EXPECT_LE(record["theta_deg"], 180);
        const Section section = truth.page.pattern.section;
        EXPECT_EQ(record["section"], json({section.u, section.v}));
        EXPECT_EQ(record["attempt"], "first");
        EXPECT_GT(record["dots_seen"], 100);
        EXPECT_LE(record["dots_used"], record["dots_seen"]);
        EXPECT_LE(record["p_wrong"], 1e-9);
        EXPECT_GE(record["p_wrong"], 1e-30);
        EXPECT_NEAR(record["sigma_x_mm"], 0.001, 0.0009);
        EXPECT_GT(record["sigma_theta_deg"], 0);
        EXPECT_NEAR(record["spacing_px"], 11.043, 0.05);
        EXPECT_GT(record["residual_px"], 0);
        EXPECT_GT(record["elapsed_us"], 0);
    }
}

TEST_F(LocateCommand, a_known_error_rate_locates_smaller_views) {
    ASSERT_EQ(ToolCommand::run("simulate -o frames --frames 20 --size 96x96"), 0) << errors_;
    std::string names;
    for (int i = 0; i < 20; ++i)
        names += " frames/frame_0000" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".pgm";
    const auto located = [&](const std::string& options) {
        run("--code anoto" + options + names);
        int count = 0;
        for (const json& record : records())
            count += record["status"] == "ok" ? 1 : 0;
        return count;
    };
    EXPECT_LE(located(""), 12);
    EXPECT_GE(located(" --bits-per-error 1000"), 15);
    EXPECT_GT(located(" --bits-per-error measured"), located(""));
    run("--bits-per-error 65537" + names);
    EXPECT_EQ(exit_code_, 2);
    EXPECT_THAT(errors_, HasSubstr("'65537' is not 'measured' or a number"));
    run("--code anoto --threads 2 --bits-per-error measured" + names);
    EXPECT_EQ(exit_code_, 2);
    EXPECT_THAT(errors_, HasSubstr("--threads needs another --bits-per-error"));
}

TEST_F(LocateCommand, shows_six_decimals_of_positions) {
    write_frame("a.pgm", 0);
    run("a.pgm");
    for (const char* field : {"\"x_mm\":", "\"y_mm\":", "\"x_grid\":", "\"y_grid\":"}) {
        const std::size_t at = output_.find(field);
        ASSERT_NE(at, std::string::npos);
        const std::size_t point = output_.find('.', at);
        EXPECT_EQ(output_.find(',', at) - point, 7U) << output_;
    }
}

TEST_F(LocateCommand, every_file_gets_one_line_or_one_message_in_order) {
    write_frame("good.pgm", 1);
    fs::create_directory(directory_ / "folder");
    write("empty.png", "");
    write("text.jpg", "this is no image\n");
    const std::string pgm = read_file(directory_ / "good.pgm");
    write("cut.pgm", pgm.substr(0, pgm.size() / 2));
    write_png(directory_ / "whole.png", render(shot(1)).view());
    const std::string png = read_file(directory_ / "whole.png");
    write("cut.png", png.substr(0, png.size() / 2));
    write("cut.jpg",
          std::string("\xff\xd8\xff\xe0\x00\x10JFIF\x00\x01\x01\x00\x00\x01\x00\x01", 18));
    write_level("flat.pgm", 64, 64);
    run("missing.png good.pgm folder empty.png text.jpg flat.pgm cut.pgm cut.png cut.jpg "
        "whole.png");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(files(), ElementsAre("good.pgm", "flat.pgm", "whole.png"));
    const std::vector<std::string> messages = lines_of(errors_);
    const char* const bad[] = {"missing.png", "folder",  "empty.png", "text.jpg",
                               "cut.pgm",     "cut.png", "cut.jpg"};
    ASSERT_EQ(messages.size(), std::size(bad)) << errors_;
    for (std::size_t i = 0; i < std::size(bad); ++i) {
        EXPECT_THAT(messages[i], StartsWith("dotpose: ")) << errors_;
        EXPECT_THAT(messages[i], HasSubstr(std::string(bad[i]) + ": ")) << errors_;
    }
}

TEST_F(LocateCommand, frames_without_a_fix_are_lines_with_a_reason) {
    write_level("one.pgm", 1, 1);
    write_level("wide.pgm", 100'000, 1);
    write_level("large.pgm", 4097, 100);
    write_level("flat.pgm", 64, 64);
    GreyImage noise{{}, 4096, 4096};
    Rng rng(3);
    for (int i = 0; i < 4096 * 4096; ++i) {
        noise.pixels.push_back(static_cast<std::uint8_t>(rng.bits() & 255U));
    }
    write_pgm(directory_ / "noise.pgm", noise.view());
    run("one.pgm wide.pgm large.pgm flat.pgm noise.pgm");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(errors_, IsEmpty());
    const std::vector<json> found = records();
    ASSERT_EQ(found.size(), 5U);
    EXPECT_EQ(found[0]["status"], "image_too_small");
    EXPECT_EQ(found[0]["message"], "the image is 1 x 1 px; at least 64 x 64 are needed");
    EXPECT_EQ(found[1]["status"], "image_too_small");
    EXPECT_EQ(found[2]["status"], "image_too_large");
    EXPECT_EQ(found[2]["message"],
              "the image is 4097 x 100 px; at most 4096 x 4096 can be located");
    EXPECT_THAT(found[3]["message"].get<std::string>(), Not(IsEmpty()));
    EXPECT_EQ(found[3]["dots_seen"], 0);
    for (const json& record : found) {
        EXPECT_NE(record["status"], "ok") << record;
        EXPECT_TRUE(record.contains("elapsed_us"));
        for (const char* field : {"x_mm", "theta_deg", "section", "p_wrong", "sigma_x_mm"}) {
            EXPECT_FALSE(record.contains(field)) << record;
        }
    }
}

TEST_F(LocateCommand, sixteen_bits_and_transparency_change_nothing) {
    const GreyImage image = render(shot(2));
    write_pgm(directory_ / "grey.pgm", image.view());
    std::vector<std::uint16_t> deep;
    std::vector<std::uint8_t> ink;  // black pixels whose opacity encodes the image
    for (const std::uint8_t level : image.pixels) {
        deep.push_back(static_cast<std::uint16_t>(level * 257));
        ink.push_back(0);
        ink.push_back(static_cast<std::uint8_t>(255 - level));
    }
    write_as_png("deep.png", image, PNG_FORMAT_LINEAR_Y, deep.data());
    write_as_png("ink.png", image, PNG_FORMAT_GA, ink.data());
    run("--code anoto grey.pgm deep.png ink.png");
    EXPECT_EQ(exit_code_, 0) << errors_;
    std::vector<json> found = records();
    ASSERT_EQ(found.size(), 3U);
    for (json& record : found) {
        record.erase("file");
        record.erase("elapsed_us");
        EXPECT_EQ(record, found[0]);
    }
    EXPECT_EQ(found[0]["status"], "ok");
}

TEST_F(LocateCommand, reads_the_formats_of_phones) {
    const Shot truth = shot(1);
    write_png(directory_ / "frame.png", render(truth).view());
    fs::create_directory(directory_ / "photos");
    if (shell("cwebp -quiet -q 90 frame.png -o photos/photo.webp && "
              "heif-enc -q 90 frame.png -o photos/photo.heic") != 0)
        GTEST_SKIP() << errors_ << "scripts/setup tests installs cwebp and heif-enc";
    run("photos");
    if (errors_.find("which is not read") != std::string::npos) GTEST_SKIP() << errors_;
    EXPECT_EQ(exit_code_, 0) << errors_;
    EXPECT_THAT(files(), ElementsAre("photos/photo.heic", "photos/photo.webp"));
    for (const json& record : records()) {
        EXPECT_NEAR(record["x_grid"], x_grid(truth.pose), 0.03);
        EXPECT_NEAR(record["y_grid"], y_grid(truth.pose), 0.03);
    }
}

TEST_F(LocateCommand, names_may_come_from_a_list) {
    write_frame("a b.pgm", 0);
    write_frame("c.pgm", 1);
    write_frame("d.pgm", 2);
    write("names.txt", "a b.pgm\n\nmissing.pgm\nc.pgm");
    run("--list names.txt d.pgm");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(files(), ElementsAre("d.pgm", "a b.pgm", "c.pgm"));
    run("--list -", "names.txt");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(files(), ElementsAre("a b.pgm", "c.pgm"));
    run("--list -");  // an empty list
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, IsEmpty());
    for (const char* list : {"none.txt", "."}) {
        run(std::string("--list ") + list);
        EXPECT_EQ(exit_code_, 1) << list;
        EXPECT_THAT(errors_, StartsWith("dotpose: ")) << list;
    }
}

TEST_F(LocateCommand, csv_says_the_same_as_json) {
    write_frame("a.pgm", 3);
    write_level("b, \"flat\".pgm", 64, 64);
    const std::string names = "a.pgm 'b, \"flat\".pgm'";
    run(names);
    const std::vector<json> expected = records();
    run("--format csv --columns all " + names);
    EXPECT_EQ(exit_code_, 0);
    const std::vector<std::string> lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 3U);
    const std::vector<std::string> header = cells_of(lines[0]);
    for (std::size_t row = 0; row < 2; ++row) {
        const std::vector<std::string> cells = cells_of(lines[row + 1]);
        ASSERT_EQ(cells.size(), header.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (header[i] == "elapsed_us") continue;
            const json value = value_in(expected[row], header[i]);
            if (value.is_null()) {
                EXPECT_EQ(cells[i], "") << header[i];
            } else if (value.is_string()) {
                EXPECT_EQ(cells[i], value.get<std::string>());
            } else {
                EXPECT_EQ(std::stod(cells[i]), value.get<double>()) << header[i];
            }
        }
    }
}

TEST_F(LocateCommand, csv_is_brief_unless_all_columns_are_wanted) {
    write_frame("a.pgm", 3);
    run("a.pgm");
    const json line = records().at(0);
    run("--format csv a.pgm");
    const std::vector<std::string> lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0],
              "file,status,message,x_mm,y_mm,theta_deg,p_wrong,sigma_x_mm,sigma_y_mm,"
              "sigma_theta_deg,warning");
    const std::vector<std::string> cells = cells_of(lines[1]);
    EXPECT_EQ(std::stod(cells.at(3)), line["x_mm"].get<double>());
    EXPECT_EQ(std::stod(cells.at(6)), line["p_wrong"].get<double>());
    run("--columns all a.pgm");
    EXPECT_EQ(exit_code_, 2);
    EXPECT_THAT(errors_, HasSubstr("--columns is for --format csv only"));
}

TEST_F(LocateCommand, text_is_a_line_to_read) {
    const Shot truth = shot(3);
    write_frame("a.pgm", 3);
    write_level("flat.pgm", 64, 64);
    run("a.pgm");
    const json line = records().at(0);
    run("--format text a.pgm flat.pgm");
    EXPECT_EQ(exit_code_, 0);
    const std::vector<std::string> lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 2U);
    double x_mm = 0;
    double sigma_x_mm = 0;
    double y_mm = 0;
    double sigma_y_mm = 0;
    double angle_deg = 0;
    double sigma_deg = 0;
    ASSERT_EQ(
        std::sscanf(lines[0].c_str(), "a.pgm: x %lf ± %lf mm, y %lf ± %lf mm, angle %lf ± %lf deg",
                    &x_mm, &sigma_x_mm, &y_mm, &sigma_y_mm, &angle_deg, &sigma_deg),
        6)
        << lines[0];
    EXPECT_NEAR(x_mm, x_grid(truth.pose) * kDefaultSpacing_mm, 0.015);
    EXPECT_NEAR(y_mm, y_grid(truth.pose) * kDefaultSpacing_mm, 0.015);
    EXPECT_NEAR(sigma_x_mm, line["sigma_x_mm"].get<double>(), 6e-5);
    EXPECT_NEAR(sigma_y_mm, line["sigma_y_mm"].get<double>(), 6e-5);
    EXPECT_NEAR(angle_deg, line["theta_deg"].get<double>(), 6e-4);
    EXPECT_NEAR(sigma_deg, line["sigma_theta_deg"].get<double>(), 6e-4);
    EXPECT_THAT(lines[1], StartsWith("flat.pgm: no fix (no_contrast): "));
}

TEST_F(LocateCommand, draws_one_image_into_a_file) {
    write_frame("a.pgm", 0);
    write_level("flat.pgm", 64, 64);
    run("--draw picture.svg a.pgm");
    EXPECT_EQ(exit_code_, 0) << errors_;
    EXPECT_THAT(file("picture.svg"), HasSubstr("</svg>"));
    run("--draw picture.svg flat.pgm");
    EXPECT_THAT(file("picture.svg"), HasSubstr("no fix: no_contrast"));
    const std::string message = records().at(0)["message"];
    EXPECT_THAT(file("picture.svg"), HasSubstr(message.substr(0, 40)));
    run("--draw picture.svg a.pgm flat.pgm");
    EXPECT_EQ(exit_code_, 2);
    EXPECT_THAT(errors_, HasSubstr("is the picture of a single image: name a folder"));
    run("--draw a.pgm.svg a.pgm -o a.pgm.svg");
    EXPECT_EQ(exit_code_, 2);
    run("--draw picture.png a.pgm");
    EXPECT_EQ(exit_code_, 2);
    EXPECT_THAT(errors_, HasSubstr("would contain an SVG picture"));
    EXPECT_FALSE(fs::exists(directory_ / "picture.png"));
    fs::create_directory(directory_ / "folder.svg");
    run("--draw folder.svg a.pgm flat.pgm");
    EXPECT_TRUE(fs::exists(directory_ / "folder.svg/flat.svg"));
}

TEST_F(LocateCommand, names_that_are_no_utf8_give_valid_json) {
    write_frame("\xff\"\\\n.pgm", 0);
    run("*.pgm");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(files(), ElementsAre("\xef\xbf\xbd\"\\\n.pgm"));
}

TEST_F(LocateCommand, spacing_and_code_and_reference_are_used) {
    const Shot truth = shot(5);
    write_frame("a.pgm", 5);
    run("--spacing 1 a.pgm");
    EXPECT_NEAR(records().at(0)["x_mm"], x_grid(truth.pose), 0.03);

    run("--code microdots a.pgm");
    EXPECT_NE(records().at(0)["status"], "ok");

    const Vec2 offset_mm = Projection(truth.camera, truth.pose).offset_from_pixel({20, 100});
    run("--reference 20,100 a.pgm");
    EXPECT_NEAR(records().at(0)["x_mm"], x_grid(truth.pose) * 0.508 + offset_mm.x, 0.02);
    EXPECT_NEAR(records().at(0)["y_mm"], y_grid(truth.pose) * 0.508 + offset_mm.y, 0.02);
}

TEST_F(LocateCommand, the_lens_is_used) {
    Shot truth = shot(6);
    truth.camera.width_px = 376;
    truth.camera.height_px = 240;
    truth.camera.k = -5e-6;
    write_pgm(directory_ / "a.pgm", render(truth).view());
    run("--k -5e-6 a.pgm");
    const json with_lens = records().at(0);
    ASSERT_EQ(with_lens["status"], "ok");
    EXPECT_NEAR(with_lens["x_grid"], x_grid(truth.pose), 0.03);
    EXPECT_LT(with_lens["residual_px"], 0.5);
    run("a.pgm");
    const json without = records().at(0);
    // Without --k, the pose fit must also estimate the lens distortion. The fit then uses fewer
    // dots, and the fix is less accurate.
    if (without["status"] == "ok") {
        EXPECT_LT(without["dots_used"], 0.95 * with_lens["dots_used"].get<double>()) << without;
        EXPECT_GT(without["sigma_x_mm"], 1.2 * with_lens["sigma_x_mm"].get<double>()) << without;
    }
}

TEST_F(LocateCommand, white_dots_on_black_are_read_if_told) {
    GreyImage image = render(shot(3));
    for (std::uint8_t& grey : image.pixels)
        grey = static_cast<std::uint8_t>(255 - grey);
    write_pgm(directory_ / "inverted.pgm", image.view());
    write_frame("usual.pgm", 3);

    run("inverted.pgm");
    EXPECT_NE(records().at(0)["status"], "ok");
    run("--inverted --draw . inverted.pgm usual.pgm");
    EXPECT_EQ(exit_code_, 0);
    const json found = records().at(0);
    ASSERT_EQ(found["status"], "ok");
    const Shot truth = shot(3);
    EXPECT_NEAR(found["x_grid"], x_grid(truth.pose), 0.03);
    EXPECT_NEAR(found["y_grid"], y_grid(truth.pose), 0.03);
    EXPECT_NE(records().at(1)["status"], "ok");

    // The picture shows the inverted image, in which the dots are dark.
    run("--draw . usual.pgm");
    const auto pixels_in = [this](const std::string& picture) {
        const std::string svg = file(picture);
        const std::size_t begin = svg.find("data:image/png;base64,");
        EXPECT_NE(begin, std::string::npos);
        return svg.substr(begin, svg.find('"', begin) - begin);
    };
    EXPECT_EQ(pixels_in("inverted.svg"), pixels_in("usual.svg"));
}

// 508 is the spacing in micrometres, 0.0005 is half a millimetre in metres, and the other spacings
// are just outside the valid range.
TEST_F(LocateCommand, a_spacing_in_another_unit_is_refused) {
    write_frame("a.pgm", 0);
    for (const std::string spacing : {"508", "0.0005", "100.1", "0.0099"}) {
        run("--spacing " + spacing + " a.pgm");
        EXPECT_EQ(exit_code_, 2) << spacing;
        EXPECT_THAT(errors_, HasSubstr("'" + spacing + "' is not a spacing in mm from")) << spacing;
        EXPECT_THAT(output_, IsEmpty()) << spacing;
    }
    for (const std::string spacing : {"100", "0.01"}) {
        run("--spacing " + spacing + " a.pgm");
        EXPECT_EQ(exit_code_, 0) << spacing << errors_;
    }
}

TEST_F(LocateCommand, draws_a_picture_for_each_image) {
    write_frame("a.pgm", 0);
    write_png(directory_ / "a.png", render(shot(1)).view());
    write_level("flat<&>.pgm", 64, 64);
    run("--draw new/folder a.pgm");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(errors_, StartsWith("dotpose: cannot create the folder new/folder: No such file"));
    EXPECT_FALSE(fs::exists(directory_ / "new"));
    fs::create_directory(directory_ / "new");
    run("--draw new/folder a.pgm a.png 'flat<&>.pgm' missing.pgm");
    EXPECT_EQ(exit_code_, 1);
    std::vector<std::string> pictures;
    for (const auto& entry : fs::directory_iterator(directory_ / "new/folder")) {
        pictures.push_back(entry.path().filename());
        const std::string svg = read_file(entry.path());
        EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty()) << entry.path();
        EXPECT_THAT(svg, HasSubstr("data:image/png;base64,"));
    }
    EXPECT_THAT(pictures, testing::UnorderedElementsAre("a.svg", "a-2.svg", "flat<&>.svg"));

    fs::create_directory(directory_ /
                         "new/folder/b.svg");  // a directory, so b.svg cannot be written
    write_frame("b.pgm", 2);
    run("--draw new/folder b.pgm a.pgm");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(files(), ElementsAre("b.pgm", "a.pgm"));
    EXPECT_THAT(errors_, StartsWith("dotpose: cannot write new/folder/b.svg"));

    run("--draw a.pgm a.png");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(output_, IsEmpty());
    EXPECT_THAT(errors_, HasSubstr("a.pgm"));
}

TEST_F(LocateCommand, output_can_go_to_a_file) {
    write_frame("a.pgm", 0);
    run("-o out.jsonl a.pgm");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, IsEmpty());
    EXPECT_EQ(json::parse(read_file(directory_ / "out.jsonl"))["status"], "ok");
    run("-o no/such/folder a.pgm");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(errors_, HasSubstr("no/such/folder"));
    if (fs::exists("/dev/full")) {
        run("-o /dev/full a.pgm");
        EXPECT_EQ(exit_code_, 1);
        EXPECT_THAT(errors_, Not(IsEmpty()));
    }
}

TEST_F(LocateCommand, lines_leave_at_once) {
    write_frame("a.pgm", 0);
    // The script prints one name, and then waits up to 10 seconds until the tool has printed its
    // first line. A tool that reads the whole list first would fail this test, because the list
    // ends only when the script ends.
    write("names.sh",
          "echo a.pgm\n"
          "for i in $(seq 100); do [ -s out ] && echo yes > came && break; sleep 0.1; done\n");
    ASSERT_EQ(shell("sh names.sh | $T locate --list - > out"), 0);
    EXPECT_EQ(read_file(directory_ / "came"), "yes\n");
}

TEST_F(LocateCommand, wrong_usage_is_status_2_with_a_message) {
    write_frame("a.pgm", 0);
    const char* const wrong[] = {
        "",                         // no images
        "--format xml a.pgm",       // unknown format
        "--format",                 // no value
        "--code 7 a.pgm",           // not a name
        "--spacing 0 a.pgm",        // not a length
        "--spacing -1 a.pgm",       //
        "--k 1 a.pgm",              // more distortion than any lens has
        "--k nan a.pgm",            //
        "--k wide a.pgm",           //
        "--reference 1 a.pgm",      // only one coordinate
        "--reference 1,x a.pgm",    //
        "--reference 1,nan a.pgm",  //
        "--reference 1e9,1 a.pgm",  // far outside the image
        "--bogus a.pgm",            //
    };
    for (const char* arguments : wrong) {
        run(arguments);
        EXPECT_EQ(exit_code_, 2) << arguments;
        EXPECT_THAT(errors_, StartsWith("dotpose: ")) << arguments;
        EXPECT_THAT(output_, IsEmpty()) << arguments;
    }
}

TEST_F(LocateCommand, help_shows_an_example_and_all_options) {
    run("--help");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr("dotpose locate --format csv frames/*.pgm > poses.csv"));
    for (const char* option : {"--list", "--spacing", "--code", "--k", "--reference", "--format",
                               "--out", "--draw", "--sheets", "--inverted", "sources"}) {
        EXPECT_THAT(output_, HasSubstr(option));
    }
}

TEST_F(LocateCommand, threads_give_the_same_lines_in_the_same_order) {
    fs::create_directory(directory_ / "frames");
    for (std::uint64_t i = 0; i < 20; ++i)
        write_frame("frames/" + std::to_string(100 + i) + ".pgm", i);
    write("frames/105.pgm", "no image");
    write_level("frames/107.pgm", 188, 120);
    const auto lines_without_times = [&] {
        std::vector<json> lines = records();
        for (json& line : lines)
            line.erase("elapsed_us");
        return lines;
    };
    EXPECT_EQ(run("--code anoto frames"), 1);
    const std::vector<json> one = lines_without_times();
    const std::string errors_of_one = errors_;
    ASSERT_EQ(one.size(), 19U);
    for (const char* threads : {"2", "3", "50"}) {
        EXPECT_EQ(run(std::string("--code anoto frames --threads ") + threads), 1);
        EXPECT_EQ(lines_without_times(), one) << threads;
        EXPECT_EQ(errors_, errors_of_one);
    }
    EXPECT_EQ(run("--threads 2 frames"), 2);
    EXPECT_THAT(errors_, HasSubstr("--code"));
    EXPECT_EQ(run("--threads 2 --code anoto - --size 188x120"), 2);
    EXPECT_EQ(run("--threads 2 --code anoto --draw pictures frames"), 2);
}

TEST_F(LocateCommand, the_ending_of_the_output_chooses_the_format) {
    write_frame("a.pgm", 1);
    ASSERT_EQ(run("a.pgm --format csv"), 0) << errors_;
    const std::string header = lines_of(output_)[0];
    ASSERT_EQ(run("a.pgm -o out.csv"), 0) << errors_;
    EXPECT_EQ(lines_of(file("out.csv"))[0], header);
    ASSERT_EQ(run("a.pgm -o OUT.CSV"), 0) << errors_;
    EXPECT_EQ(lines_of(file("OUT.CSV"))[0], header);
    ASSERT_EQ(run("a.pgm -o out.csv --format json"), 0) << errors_;
    EXPECT_THAT(file("out.csv"), StartsWith("{"));
    ASSERT_EQ(run("a.pgm -o out.txt"), 0) << errors_;
    EXPECT_THAT(file("out.txt"), StartsWith("{"));
    ASSERT_EQ(ToolCommand::run("watch a.pgm -o watch.csv"), 0) << errors_;
    EXPECT_THAT(file("watch.csv"), StartsWith("schema,"));
    ASSERT_EQ(ToolCommand::run("simulate -o frames --frames 2"), 0) << errors_;
    ASSERT_EQ(ToolCommand::run("evaluate frames -o report.json"), 0) << errors_;
    EXPECT_TRUE(json::accept(file("report.json")));
}

}  // namespace
}  // namespace dotpose::test

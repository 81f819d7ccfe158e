// Tests commands on sheets whose code is unknown. The tool must detect the code, or report that
// several codes are possible.
#include <cmath>
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../scanned_page.hpp"
#include "dotpose/files/code_names.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

/// Positions modulo 241, the period of the sequence a4. Between positions 222 and 238, the digits
/// of a4 in the `anoto` code equal those in the `libdots` code, shifted by one position
/// (docs/position-code.md). A view centred on kShifted therefore occurs in both codes, but at
/// different positions. A view centred on kCommon occurs in both codes at the same position. A view
/// centred on kBorder occurs in only one code.
constexpr std::uint32_t kPeriod = 241;
constexpr std::uint32_t kShifted = 231;
constexpr std::uint32_t kBorder = 221;
constexpr std::uint32_t kCommon = 100;

/// Returns a frame of 17 x 10 dots without rotation. Its centre is at cell (x, y) modulo kPeriod.
Shot shot_at(CodeVariant code, std::uint32_t x, std::uint32_t y) {
    Shot shot = test::shot(3);
    shot.page.pattern.code = code;
    shot.page.pattern.section = {};
    shot.pose.cell = {1000 * kPeriod + x, 2000 * kPeriod + y};
    shot.pose.theta_rad = 0;
    return shot;
}

class AnyCode : public LocateCommand {
  protected:
    Shot write_at(const std::string& name, CodeVariant code, std::uint32_t x, std::uint32_t y) {
        const Shot shot = shot_at(code, x, y);
        write_pgm(directory_ / name, render(shot).view());
        return shot;
    }

    static bool is_at(const json& record, const std::string& x, const std::string& y,
                      const Shot& truth) {
        return std::abs(record[x].get<double>() - x_grid(truth.pose) * 0.508) < 0.02 &&
               std::abs(record[y].get<double>() - y_grid(truth.pose) * 0.508) < 0.02;
    }
};

TEST_F(AnyCode, is_named_where_the_frame_tells_it) {
    for (const CodeVariant code :
         {CodeVariant::anoto, CodeVariant::libdots, CodeVariant::microdots}) {
        const Shot truth = write_at("a.pgm", code, kCommon, kBorder);
        run("a.pgm");
        const json record = records().at(0);
        EXPECT_EQ(record["status"], "ok") << record;
        EXPECT_EQ(record["code"], name(code));
        EXPECT_LT(record["code_p_wrong"], 1e-3) << record;
        EXPECT_TRUE(is_at(record, "x_mm", "y_mm", truth)) << record;
    }
}

TEST_F(AnyCode, is_open_where_codes_agree_and_the_place_is_not) {
    const Shot truth = write_at("a.pgm", CodeVariant::libdots, kCommon, kCommon);
    run("a.pgm");
    const json record = records().at(0);
    EXPECT_EQ(record["status"], "ok");
    EXPECT_GT(record["code_p_wrong"], 0.3);
    EXPECT_TRUE(is_at(record, "x_mm", "y_mm", truth)) << record;
}

TEST_F(AnyCode, two_places_are_told_where_both_explain_the_frame) {
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::libdots}) {
        const Shot truth = write_at("a.pgm", code, kCommon, kShifted);
        run("a.pgm");
        const json record = records().at(0);
        EXPECT_EQ(record["status"], "ambiguous_code") << record;
        EXPECT_FALSE(record.contains("x_mm"));
        EXPECT_THAT(record["message"], HasSubstr("--code"));
        const bool is_first = record["code"] == name(code);
        EXPECT_EQ(record[is_first ? "code" : "other_code"], name(code)) << record;
        EXPECT_TRUE(is_first ? is_at(record, "code_x_mm", "code_y_mm", truth)
                             : is_at(record, "other_x_mm", "other_y_mm", truth))
            << record;
    }
}

TEST_F(AnyCode, other_frames_of_the_call_decide) {
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::libdots}) {
        // The first two frames are at kBorder, and therefore occur in only one code. The third
        // frame occurs in both codes.
        write_at("1.pgm", code, kCommon, kBorder);
        write_at("2.pgm", code, kBorder + kPeriod, kCommon);
        const Shot truth = write_at("3.pgm", code, kCommon, kShifted);
        run("1.pgm 2.pgm 3.pgm");
        const json record = records().at(2);
        EXPECT_EQ(record["status"], "ok") << record;
        EXPECT_EQ(record["code"], name(code));
        EXPECT_LE(record["p_wrong"], 1e-9);
        EXPECT_TRUE(is_at(record, "x_mm", "y_mm", truth)) << record;
        run("3.pgm 1.pgm");
        EXPECT_EQ(records().at(0)["status"], "ambiguous_code");
    }
}

TEST_F(AnyCode, given_decides_and_another_that_explains_the_frame_is_a_warning) {
    const Shot truth = write_at("a.pgm", CodeVariant::libdots, kCommon, kShifted);
    run("--code libdots a.pgm");
    const json right = records().at(0);
    EXPECT_EQ(right["status"], "ok") << right;
    EXPECT_TRUE(is_at(right, "x_mm", "y_mm", truth)) << right;
    EXPECT_THAT(right["warning"], HasSubstr("anoto"));

    run("--code anoto a.pgm");
    const json wrong = records().at(0);
    EXPECT_EQ(wrong["status"], "ok") << wrong;
    EXPECT_EQ(wrong["other_code"], "libdots");
    EXPECT_TRUE(is_at(wrong, "other_x_mm", "other_y_mm", truth)) << wrong;

    // If a frame has no position in the given code, the warning names a code in which the frame
    // does have a position.
    run("--code microdots a.pgm");
    const json none = records().at(0);
    EXPECT_NE(none["status"], "ok");
    EXPECT_THAT(none["warning"], AnyOf(HasSubstr("anoto"), HasSubstr("libdots"))) << none;
}

TEST_F(AnyCode, a_common_frame_has_no_warning) {
    write_at("a.pgm", CodeVariant::anoto, kCommon, kCommon);
    run("--code anoto a.pgm");
    EXPECT_FALSE(records().at(0).contains("warning")) << records().at(0);
}

TEST_F(AnyCode, another_sheet_is_known_after_two_of_its_places) {
    std::string names;
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::microdots}) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::string file = std::string(name(code)) + std::to_string(i) + ".pgm";
            write_at(file, code, kCommon, kBorder + i * kPeriod);
            names += " " + file;
        }
    }
    run(names);
    EXPECT_EQ(records().at(3)["code"], "anoto");
    EXPECT_EQ(records().at(7)["status"], "ok") << records().at(7);
    EXPECT_EQ(records().at(7)["code"], "microdots");
}

TEST_F(AnyCode, frames_of_a_video_decide) {
    write_at("a1.pgm", CodeVariant::libdots, kCommon, kBorder);
    write_at("a2.pgm", CodeVariant::libdots, kBorder + kPeriod, kCommon);
    const Shot truth = write_at("a3.pgm", CodeVariant::libdots, kCommon, kShifted);
    ToolCommand::run("watch 'a*.pgm' --fps 1");
    const std::vector<json> watched = records();
    ASSERT_EQ(watched.size(), 3U) << errors_;
    EXPECT_EQ(watched[2]["status"], "ok") << watched[2];
    EXPECT_EQ(watched[2]["code"], "libdots");
    EXPECT_TRUE(is_at(watched[2], "x_mm", "y_mm", truth)) << watched[2];
}

TEST_F(AnyCode, a_page_tells_it_to_check_print) {
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::libdots}) {
        SheetOptions options;
        options.paper = {60, 50};
        options.pattern.code = code;
        options.origin = {2 * kPeriod - 50, 3 * kPeriod - 50};
        write_png(directory_ / "scan.png", scan_page(make_sheet(options), {}).view());
        ToolCommand::run("check-print scan.png --dpi 600 --format json");
        const json report = json::parse(output_);
        EXPECT_EQ(report["code"], name(code)) << report;
        EXPECT_LT(report["code_p_wrong"], 1e-6);
        ASSERT_EQ(report["fields"].size(), 1U);
        EXPECT_EQ(report["fields"][0]["bits_wrong"], 0);
        const bool is_anoto = code == CodeVariant::anoto;
        EXPECT_EQ(ToolCommand::run(std::string("check-print scan.png --dpi 600 --code ") +
                                   (is_anoto ? "libdots" : "anoto")),
                  3);
        EXPECT_THAT(output_, HasSubstr(std::string("FAULT: the page is of code ") + name(code)));
        EXPECT_THAT(output_, Not(HasSubstr("are wrong, because")));
    }
}

TEST_F(AnyCode, each_frame_is_evaluated_by_itself) {
    ASSERT_EQ(ToolCommand::run("simulate -o frames --frames 8 --seed 3 --code libdots"), 0);
    ASSERT_EQ(ToolCommand::run("evaluate frames --code auto --format json"), 0);
    const json any = json::parse(output_);
    EXPECT_EQ(any["wrong"], 0) << any;
    EXPECT_GE(any["located"], 6) << any;
}

TEST_F(AnyCode, names_that_there_are_not_are_refused) {
    run("--code livescribe a.pgm");
    EXPECT_NE(exit_code_, 0);
    EXPECT_THAT(errors_, HasSubstr("'livescribe' is not auto, anoto, libdots or microdots"));
}

}  // namespace
}  // namespace dotpose::test

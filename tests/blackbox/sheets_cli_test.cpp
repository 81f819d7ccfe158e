// Tests `dotpose sheets`, which edits sheet files.
#include <filesystem>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../xml_check.hpp"
#include "sheets_command.hpp"

namespace dotpose::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class SheetsTool : public SheetsCommand {
  protected:
    int sheets_tool(const std::string& arguments) {
        return ToolCommand::run("sheets " + arguments);
    }

    void print_small(const std::string& name, const std::string& more = "") {
        ASSERT_EQ(print("-o " + name + ".svg --paper 40x30 --sheets sheets.json --name " + name +
                        " " + more),
                  0)
            << errors_;
    }
};

TEST_F(SheetsTool, a_place_is_entered_listed_shown_and_taken_back) {
    print_small("table");
    print_small("shelf");
    edit_sheet(0, [](json& sheet) { sheet["room"] = "kitchen"; });
    ASSERT_EQ(sheets_tool("place table --x 1250 --y -500.5 --yaw 90"), 0) << errors_;
    EXPECT_EQ(output_,
              "table: its top left corner is at x 1250 mm, y -500.5 mm in the world, yaw 90 deg\n");
    const json world = sheets().at(0)["world"];
    EXPECT_DOUBLE_EQ(world["x_m"], 1.25);
    EXPECT_DOUBLE_EQ(world["y_m"], -0.5005);
    EXPECT_DOUBLE_EQ(world["yaw_rad"], std::numbers::pi / 2);
    EXPECT_EQ(sheets().at(0)["room"], "kitchen");
    EXPECT_FALSE(sheets().at(1).contains("world"));

    ASSERT_EQ(sheets_tool("list"), 0);
    EXPECT_THAT(output_,
                ContainsRegex("table +40 x 30 mm +1024,1024 to [0-9,]+ +1250 +-500.5 +90\n"));
    EXPECT_THAT(output_, ContainsRegex("shelf +40 x 30 mm .* - +- +-\n"));
    ASSERT_EQ(sheets_tool("show table --sheets sheets.json"), 0);
    EXPECT_THAT(output_, AllOf(HasSubstr("x 1250 mm, y -500.5 mm"), HasSubstr("0.508 mm"),
                               HasSubstr("page 1 of 1 of 'table', for 600 dpi")));

    ASSERT_EQ(sheets_tool("place table --unknown"), 0) << errors_;
    EXPECT_FALSE(sheets().at(0).contains("world"));
    EXPECT_EQ(sheets().at(0)["room"], "kitchen");
}

TEST_F(SheetsTool, a_new_name_keeps_all_else) {
    print_small("table");
    print_small("shelf");
    ASSERT_EQ(sheets_tool("place table --x 1 --y 2 --yaw 3"), 0) << errors_;
    edit_sheet(0, [](json& sheet) { sheet["room"] = "kitchen"; });
    json expected = sheets();
    expected[0]["name"] = "desk";
    ASSERT_EQ(sheets_tool("rename table desk"), 0) << errors_;
    EXPECT_EQ(sheets(), expected);
    // The sheet that was called `table` is now called `desk`. Another sheet that is renamed to
    // `table` must not inherit the properties of `desk`.
    ASSERT_EQ(sheets_tool("rename shelf table"), 0) << errors_;
    EXPECT_FALSE(sheets().at(1).contains("room"));
    ASSERT_EQ(sheets_tool("remove desk"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("do not use its page"));
    ASSERT_EQ(sheets().size(), 1U);
    EXPECT_EQ(sheets().at(0)["name"], "table");
}

TEST_F(SheetsTool, reprint_makes_the_very_same_page) {
    ASSERT_EQ(print("-o tiles.pdf --paper A6 --pages 3 --dpi 1200 --section 4,5 --spacing 0.6 "
                    "--sheets sheets.json --name tiles"),
              0)
        << errors_;
    ASSERT_EQ(print("-o door.pdf --paper A6 --sheets sheets.json --name 'the door'"), 0);
    ASSERT_EQ(print("-o raw.pdf --paper A6 --no-labels --dots strokes --sheets sheets.json "
                    "--name raw"),
              0);
    print_small("small");
    ASSERT_EQ(sheets_tool("rename 'the door' door"), 0);
    for (const std::string name : {"door.pdf", "raw.pdf", "small.svg"}) {
        const std::string sheet = fs::path(name).stem().string();
        ASSERT_EQ(sheets_tool("reprint " + sheet + " -o again-" + name), 0) << errors_;
        EXPECT_THAT(errors_, IsEmpty());
        EXPECT_EQ(file("again-" + name), file(name)) << name;
    }
    // The reprint of one page must have the same text and picture as the original page.
    ASSERT_EQ(sheets_tool("reprint tiles-2 -o again.pdf"), 0) << errors_;
    ASSERT_EQ(shell("pdftotext -f 2 -l 2 tiles.pdf before.txt && pdftotext again.pdf after.txt && "
                    "pdftoppm -r 300 -gray -f 2 -l 2 -singlefile tiles.pdf before && "
                    "pdftoppm -r 300 -gray -singlefile again.pdf after"),
              0)
        << errors_;
    EXPECT_THAT(file("after.txt"), HasSubstr("tiles, page 2 of 3"));
    EXPECT_EQ(file("after.txt"), file("before.txt"));
    EXPECT_EQ(file("after.pgm"), file("before.pgm"));
}

TEST_F(SheetsTool, the_command_on_a_page_makes_the_page_again) {
    ASSERT_EQ(print("-o first.pdf --paper A5 --sheets sheets.json --name first"), 0) << errors_;
    ASSERT_EQ(print("-o door.pdf --paper A5 --wait=3 --sheets=sheets.json --name door "
                    "--section 1,2"),
              0)
        << errors_;
    ASSERT_EQ(shell("pdftotext door.pdf - | tr '\\n' ' ' | grep -o 'dotpose print .*--origin "
                    "[0-9,]*'"),
              0);
    EXPECT_EQ(output_, "dotpose print -o door.pdf --paper A5 --section 1,2 --origin 2300,1024\n");
    EXPECT_EQ(sheets().at(1)["print"]["command"].get<std::string>() + "\n", output_);
    const std::string arguments =
        output_.substr(output_.find(' '), output_.find('\n') - output_.find(' '));
    ASSERT_EQ(shell("mkdir elsewhere && cd elsewhere && $T" + arguments), 0) << errors_;
    EXPECT_EQ(file("elsewhere/door.pdf"), file("door.pdf"));
}

TEST_F(SheetsTool, reprint_tells_what_an_earlier_version_did_not_keep) {
    print_small("small");
    edit_sheet(0, [](json& sheet) { sheet.erase("print"); });
    ASSERT_EQ(sheets_tool("reprint small -o again.svg"), 0) << errors_;
    EXPECT_THAT(errors_,
                HasSubstr("from an earlier version, does not say how its page was printed"));
    EXPECT_EQ(file("again.svg"), file("small.svg"));
}

TEST_F(SheetsTool, reprint_takes_away_the_mark_of_a_stopped_print) {
    print_small("small");
    edit_sheet(0, [](json& sheet) { sheet["reserved"] = true; });
    ASSERT_EQ(sheets_tool("list"), 0);
    EXPECT_THAT(output_, HasSubstr("  reserved\n"));
    ASSERT_EQ(sheets_tool("reprint small -o again.svg"), 0) << errors_;
    EXPECT_FALSE(sheets().at(0).contains("reserved"));
}

TEST_F(SheetsTool, dots_over_a_document_are_not_reprinted_without_it) {
    ASSERT_EQ(print("-o form.pdf --paper 40x30 --pages 2"), 0);
    ASSERT_EQ(shell("$T overlay form.pdf -o dots.pdf --password secret --sheets sheets.json "
                    "--name form"),
              0)
        << errors_;
    EXPECT_THAT(file("sheets.json"), Not(HasSubstr("secret")));
    EXPECT_EQ(sheets_tool("reprint form-2 -o again.pdf"), 1);
    EXPECT_THAT(errors_, AllOf(HasSubstr("over the document form.pdf"),
                               HasSubstr("dotpose overlay form.pdf -o dots.pdf --pages 2 --origin "
                                         "2107,1024")));
    EXPECT_FALSE(fs::exists(directory_ / "again.pdf"));
}

TEST_F(SheetsTool, map_shows_the_sheets_with_their_names) {
    print_small("table");
    print_small("'the shelf'");
    ASSERT_EQ(sheets_tool("place table --x 0 --y 0 --yaw -30"), 0) << errors_;
    ASSERT_EQ(sheets_tool("map -o map.svg"), 0) << errors_;
    EXPECT_THAT(XmlCheck(file("map.svg")).problem(), IsEmpty());
    EXPECT_THAT(file("map.svg"), AllOf(HasSubstr(">table</text>"), HasSubstr(">the shelf</text>")));
}

TEST_F(SheetsTool, what_cannot_be_done_is_said_and_changes_nothing) {
    print_small("table");
    print_small("shelf");
    write("wrong.json", "{}");
    const std::string before = file("sheets.json");
    const struct {
        const char* arguments;
        int exit_code;
        const char* problem;
    } wrong[] = {
        {"", 2, "no command given"},
        {"lst", 2, "unknown command 'lst'; did you mean 'list'?"},
        {"list --shets sheets.json", 2, "unknown option '--shets'; did you mean '--sheets'?"},
        {"--sheets sheets.json list", 2, "follow it: dotpose sheets list --sheets"},
        {"map -out map.svg", 2, "did you mean '--out'?"},
        {"list --sheets none.json", 1, "there is no sheet file none.json"},
        {"place table --x 1 --y 2 --yaw 3 --sheets none.json", 1, "there is no sheet file"},
        {"list --sheets wrong.json", 1, "wrong.json is not a sheet file"},
        {"list --sheets ''", 2, "the name of the sheet file is empty"},
        {"show", 2, "name is required"},
        {"show tabel", 2, "sheets.json has no sheet 'tabel'; it has table, shelf"},
        {"place tabel --x 1 --y 2 --yaw 3", 2, "sheets.json has no sheet 'tabel'"},
        {"place table --x 1 --y 2", 2, "all of --x, --y and --yaw"},
        {"place table --x 1 --y 2 --yaw 3 --unknown", 2, "--unknown"},
        {"place table --x nan --y 2 --yaw 3", 2, "'nan' is not a finite number"},
        {"place table --x 1m --y 2 --yaw 3", 2, "--x"},
        {"rename table shelf", 2, "there already is a sheet 'shelf'"},
        {"rename table ''", 2, "a name that is not empty"},
        {"rename tabel desk", 2, "has no sheet 'tabel'"},
        {"rename table", 2, "new_name is required"},
        {"remove tabel", 2, "has no sheet 'tabel'"},
        {"reprint table", 2, "--out is required"},
        {"reprint table -o sheets.json", 2, "would overwrite the input --sheets sheets.json"},
        {"reprint table -o table.doc", 2, "the name must end in"},
        {"reprint table -o none/table.svg", 1, "cannot create none/table.svg"},
        {"map", 2, "--out is required"},
        {"map -o map.png", 2, "ends like that of an image"},
        {"map -o none/map.svg", 1, "none/map.svg"},
    };
    for (const auto& [arguments, exit_code, problem] : wrong) {
        EXPECT_EQ(sheets_tool(arguments), exit_code) << arguments;
        EXPECT_THAT(errors_, StartsWith("dotpose: ")) << arguments;
        EXPECT_THAT(errors_, HasSubstr(problem)) << arguments;
        EXPECT_EQ(file("sheets.json"), before) << arguments;
        EXPECT_FALSE(fs::exists(directory_ / "none.json")) << arguments;
        EXPECT_FALSE(fs::exists(directory_ / ".sheets.json.lock")) << arguments;
    }
}

TEST_F(SheetsTool, changes_wait_for_others) {
    print_small("table");
    EXPECT_EQ(
        shell("(exec 9>.sheets.json.lock; flock 9; echo > locked; exec sleep 60) & holder=$!; "
              "until [ -e locked ]; do sleep 0.01; done; "
              "$T sheets place table --x 1 --y 2 --yaw 3 --wait 0.1; "
              "code=$?; kill $holder; wait $holder; exit $code"),
        1);
    EXPECT_THAT(errors_, HasSubstr("another program has been changing it for 0.1 s"));
    EXPECT_FALSE(sheets().at(0).contains("world"));
}

TEST_F(SheetsTool, a_measured_length_sets_the_print_scale) {
    print_small("table");
    ASSERT_EQ(sheets_tool("scale table --measured 48.5 --of 50"), 0) << errors_;
    EXPECT_EQ(output_, "table: print scale x 0.97, y 0.97\n");
    EXPECT_DOUBLE_EQ(sheets().at(0)["print_scale_x"], 0.97);
    ASSERT_EQ(sheets_tool("scale table --measured 24 --of 25 --along y"), 0) << errors_;
    EXPECT_EQ(output_, "table: print scale x 0.97, y 0.96\n");
    EXPECT_DOUBLE_EQ(sheets().at(0)["print_scale_y"], 0.96);

    const json before = sheets();
    EXPECT_EQ(sheets_tool("scale table --measured 485 --of 50"), 2);
    EXPECT_THAT(errors_, HasSubstr("0.5 to 2"));
    EXPECT_EQ(sheets_tool("scale table --measured 48.5"), 2);
    EXPECT_THAT(errors_, HasSubstr("--of"));
    EXPECT_EQ(sheets_tool("scale table --measured 1 --of 0"), 2);
    EXPECT_EQ(sheets(), before);
}

TEST_F(SheetsTool, a_measured_offset_moves_the_dots_on_the_page) {
    print_small("table");
    const json before = sheets();
    ASSERT_EQ(sheets_tool("offset table --right 5.4 --below 4.9"), 0) << errors_;
    EXPECT_EQ(output_, "table: first intersection 5.4 mm right of and 4.9 mm below the corner\n");
    EXPECT_DOUBLE_EQ(sheets().at(0)["first_x_mm"], 5.4);
    EXPECT_DOUBLE_EQ(sheets().at(0)["first_y_mm"], 4.9);

    const json moved = sheets();
    EXPECT_EQ(sheets_tool("offset table --right 500 --below 5"), 2);
    EXPECT_THAT(errors_, HasSubstr("do not fit on a page"));
    EXPECT_EQ(sheets_tool("offset table --right 5"), 2);
    EXPECT_THAT(errors_, HasSubstr("--below"));
    EXPECT_EQ(sheets(), moved);
    EXPECT_EQ(moved.at(0)["origin_x"], before.at(0)["origin_x"]);
}

}  // namespace
}  // namespace dotpose::test

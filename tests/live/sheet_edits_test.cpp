#include "sheet_edits.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../temporary_directory.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::cli {
namespace {

using testing::HasSubstr;

class SheetEditing : public testing::Test {
  protected:
    void SetUp() override {
        SheetOptions options;
        options.paper = {.width_mm = 40, .height_mm = 30};
        SheetFile file(path_);
        file.allocate("left", make_sheet(options));
        file.allocate("right", make_sheet(options));
        file.save();
    }

    static SheetEdits::Change at(double x_m) {
        return [x_m](SheetEntry entry) {
            entry.world = WorldPose{x_m, 0, 0};
            return entry;
        };
    }

    static SheetEdits::Change named(const std::string& name) {
        return [name](SheetEntry entry) {
            entry.name = name;
            return entry;
        };
    }

    /// Changes the world position of a sheet in the file, as another program would.
    void change_outside(const std::string& name, double x_m) {
        SheetFile file(path_);
        SheetEntry entry = file.sheets().at(name == "left" ? 0 : 1);
        entry.world = WorldPose{x_m, 0, 0};
        file.replace(entry);
        file.save();
    }

    double x_of(std::size_t index) const {
        const auto world = read_sheets(path_).at(index).world;
        return world ? world->x_m : std::numeric_limits<double>::quiet_NaN();
    }

    SheetEdits::Target seen(const SheetEdits& edits, const std::string& name) const {
        return {name, edits.revision(name)};
    }

    template <typename Act>
    static std::string failure(const Act& act) {
        try {
            act();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    test::TemporaryDirectory directory_;
    std::filesystem::path path_ = directory_.path() / "sheets.json";
};

TEST_F(SheetEditing, EditsAreUndoneAndDoneAgain) {
    SheetEdits edits(path_.string(), {});
    edits.change(seen(edits, "left"), "place", at(1));
    edits.change(seen(edits, "right"), "place", at(2));
    EXPECT_EQ(edits.undo_text(), "place 'right'");
    EXPECT_EQ(edits.undo(), "place 'right'");
    EXPECT_TRUE(std::isnan(x_of(1)));
    EXPECT_EQ(edits.redo_text(), "place 'right'");
    edits.undo();
    EXPECT_TRUE(std::isnan(x_of(0)));
    edits.redo();
    EXPECT_EQ(x_of(0), 1);
    // After a new edit, the undone edits can no longer be redone.
    edits.change(seen(edits, "left"), "place", at(3));
    EXPECT_EQ(edits.redo_text(), "");
    EXPECT_THAT(failure([&] { edits.redo(); }), HasSubstr("nothing to redo"));
    edits.undo();
    EXPECT_EQ(x_of(0), 1);
}

TEST_F(SheetEditing, AnEditOfAnOldStateIsRefused) {
    SheetEdits edits(path_.string(), {});
    const SheetEdits::Target old = seen(edits, "left");
    change_outside("left", 7);
    EXPECT_THAT(failure([&] { edits.change(old, "place", at(1)); }),
                HasSubstr("was changed by someone else"));
    EXPECT_EQ(x_of(0), 7);
    EXPECT_EQ(edits.undo_text(), "");
    // The change that another program made to the left sheet does not prevent edits to the right
    // sheet.
    edits.change(seen(edits, "right"), "place", at(2));
    edits.change(seen(edits, "left"), "place", at(1));
    EXPECT_EQ(x_of(0), 1);
    EXPECT_THAT(failure([&] {
                    edits.change({"gone", 1}, "place", at(1));
                }),
                HasSubstr("no sheet 'gone'"));
}

TEST_F(SheetEditing, AnEditThatWasOverwrittenIsNotUndone) {
    SheetEdits edits(path_.string(), {});
    edits.change(seen(edits, "left"), "place", at(1));
    change_outside("left", 7);
    EXPECT_THAT(failure([&] { edits.undo(); }), HasSubstr("can no longer be undone"));
    EXPECT_EQ(x_of(0), 7);
    EXPECT_EQ(edits.undo_text(), "");
}

TEST_F(SheetEditing, AnInvalidEditWritesNothing) {
    SheetEdits edits(path_.string(), {});
    const auto scale = [](SheetEntry entry) {
        entry.print_scale_x = 9;
        return entry;
    };
    EXPECT_THAT(failure([&] { edits.change(seen(edits, "left"), "scale", scale); }),
                HasSubstr("0.5 to 2"));
    EXPECT_EQ(read_sheets(path_).at(0).print_scale_x, 1);
    EXPECT_EQ(edits.undo_text(), "");
}

TEST_F(SheetEditing, ALockedFileIsNotChanged) {
    SheetEdits edits(path_.string(), {.max_s = 0.05});
    const SheetFile other(path_);
    EXPECT_THAT(failure([&] { edits.change(seen(edits, "left"), "place", at(1)); }),
                HasSubstr("cannot lock"));
    EXPECT_TRUE(std::isnan(x_of(0)));
}

TEST_F(SheetEditing, ChangesByOtherProgramsAreRead) {
    SheetEdits edits(path_.string(), {});
    const std::int64_t version = edits.version();
    EXPECT_FALSE(edits.refresh());
    change_outside("right", 4);
    EXPECT_TRUE(edits.refresh());
    EXPECT_EQ(edits.sheets().at(1).world->x_m, 4);
    EXPECT_GT(edits.version(), version);
    // While the file is invalid, the sheets of the last valid file are kept.
    const std::int64_t valid = edits.version();
    std::ofstream(path_) << "{";
    EXPECT_TRUE(edits.refresh());
    EXPECT_THAT(edits.problem(), HasSubstr("sheets.json"));
    EXPECT_EQ(edits.sheets().size(), 2U);
    EXPECT_EQ(edits.version(), valid);
}

TEST_F(SheetEditing, ASheetIsRenamedAndTheOldNameIsBackAfterUndo) {
    SheetEdits edits(path_.string(), {});
    edits.change(seen(edits, "left"), "place", at(1));
    edits.change(seen(edits, "left"), "rename", named("west"));
    EXPECT_EQ(read_sheets(path_).at(0).name, "west");
    EXPECT_EQ(x_of(0), 1);
    EXPECT_EQ(edits.undo_text(), "rename 'left'");
    edits.change(seen(edits, "west"), "place", at(2));
    edits.undo();
    edits.undo();
    EXPECT_EQ(read_sheets(path_).at(0).name, "left");
    edits.undo();
    EXPECT_TRUE(std::isnan(x_of(0)));
    for (int i = 0; i < 3; ++i)
        edits.redo();
    EXPECT_EQ(read_sheets(path_).at(0).name, "west");
    EXPECT_EQ(x_of(0), 2);
    for (const char* name : {"right", "", "a\nb"}) {
        EXPECT_NE(failure([&] { edits.change(seen(edits, "west"), "rename", named(name)); }), "");
        EXPECT_EQ(read_sheets(path_).at(0).name, "west");
    }
}

TEST_F(SheetEditing, ARemovedSheetIsBackAfterUndo) {
    SheetEdits edits(path_.string(), {});
    edits.change(seen(edits, "left"), "place", at(1));
    const std::int64_t version = edits.version();
    edits.remove(seen(edits, "left"));
    EXPECT_EQ(read_sheets(path_).size(), 1U);
    EXPECT_GT(edits.version(), version);
    EXPECT_THAT(failure([&] { edits.remove(seen(edits, "right")); }), HasSubstr("the only sheet"));
    EXPECT_EQ(edits.undo(), "remove 'left'");
    ASSERT_EQ(read_sheets(path_).size(), 2U);
    EXPECT_EQ(read_sheets(path_).at(1).name, "left");
    EXPECT_EQ(x_of(1), 1);
    edits.redo();
    EXPECT_EQ(read_sheets(path_).size(), 1U);
}

TEST_F(SheetEditing, ARemovedSheetIsNotBackIfItsCellsAreTaken) {
    SheetEdits edits(path_.string(), {});
    edits.remove(seen(edits, "left"));
    {
        SheetOptions options;
        options.paper = {.width_mm = 40, .height_mm = 30};
        SheetFile file(path_);
        file.allocate("other", make_sheet(options));
        file.save();
    }
    const std::string reason = failure([&] { edits.undo(); });
    EXPECT_THAT(reason, HasSubstr("can no longer be undone"));
    EXPECT_THAT(reason, HasSubstr("'other'"));
    EXPECT_EQ(read_sheets(path_).size(), 2U);
    EXPECT_EQ(edits.undo_text(), "");
}

TEST_F(SheetEditing, MeasuredPlacesAreOneEdit) {
    SheetEdits edits(path_.string(), {});
    const std::vector<SheetEdits::Target> targets = {seen(edits, "left"), seen(edits, "right")};
    std::vector<SheetEntry> measured = edits.sheets();
    measured[0].world = WorldPose{1, 0, 0};
    measured[1].world = WorldPose{2, 0, 0};
    measured[1].print_scale_y = 0.99;
    edits.change_all(targets, measured, "measured places");
    EXPECT_EQ(x_of(1), 2);
    EXPECT_EQ(read_sheets(path_).at(1).print_scale_y, 0.99);
    edits.undo();
    EXPECT_TRUE(std::isnan(x_of(0)) && std::isnan(x_of(1)));
    // Another program changes a sheet between the measurement and the edit.
    const std::vector<SheetEdits::Target> later = {seen(edits, "left"), seen(edits, "right")};
    change_outside("right", 5);
    EXPECT_THAT(failure([&] { edits.change_all(later, measured, "measured places"); }),
                HasSubstr("'right' was changed"));
    EXPECT_TRUE(std::isnan(x_of(0)));
}

}  // namespace
}  // namespace dotpose::cli

#include "panel_text.hpp"

#include <gmock/gmock.h>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class PanelText : public testing::Test {
  protected:
    PanelText() {
        sheet_.name = "left";
        reading_.index = 12;
        reading_.time_us = 400'000;
        reading_.record.fix.status = Status::ok;
        reading_.track.is_lost = false;
        reading_.track.pose.x_nm = 1'234'567'000;
        reading_.track.pose.y_nm = -2'000'000;
        reading_.record.place = SheetPlace{&sheet_, 50.5, 60.25, 0.5, {}};
    }

    SheetEntry sheet_;
    Reading reading_;
};

TEST_F(PanelText, ShowsTheWorldWhereItIsKnown) {
    reading_.plane = Plane::sheet_world;
    const std::vector<std::string> lines = panel_text(reading_);
    EXPECT_THAT(lines.front(), HasSubstr("frame 12   0.400 s"));
    EXPECT_THAT(lines, Contains("world (y up), sheet left"));
    EXPECT_THAT(lines, Contains("x 1234.567  y -2.000 mm"));
}

TEST_F(PanelText, ElseTheSheet) {
    const std::vector<std::string> lines = panel_text(reading_);
    EXPECT_THAT(lines, Contains("sheet left (y down)"));
    EXPECT_THAT(lines, Contains("x 50.500  y 60.250 mm"));
    EXPECT_THAT(lines, Contains(HasSubstr("28.65 deg")));  // 0.5 rad
}

TEST_F(PanelText, ElseThePattern) {
    reading_.record.place.reset();
    EXPECT_THAT(panel_text(reading_), Contains("pattern (y down)"));
    EXPECT_THAT(panel_text(reading_), Contains("x 1234.567  y -2.000 mm"));
}

TEST_F(PanelText, NoPoseWhereThereIsNone) {
    reading_.record.place.reset();
    reading_.record.fix.status = Status::no_grid;
    reading_.track.is_lost = true;
    const std::vector<std::string> lines = panel_text(reading_);
    EXPECT_THAT(lines, Contains("no_grid"));
    EXPECT_THAT(lines, Not(Contains(HasSubstr("mm"))));
}

}  // namespace
}  // namespace dotpose::cli

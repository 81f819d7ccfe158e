#include "dotpose/tools/draw.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../xml_check.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

using test::XmlCheck;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A located frame.
struct Located {
    explicit Located(const GreyImage& frame, const DeviceOptions& with = {})
        : image(frame), locator(std::make_unique<Locator>(showing(with))) {
        fix = locator->locate(image.view());
        trace = locator->trace();
    }
    std::string drawn(const DrawOptions& draw_options = {}) const {
        std::ostringstream out;
        draw_frame(out, image.view(), trace, draw_options);
        return out.str();
    }

    GreyImage image;
    std::unique_ptr<Locator> locator;
    Fix fix;
    Trace trace;

  private:
    static DeviceOptions showing(DeviceOptions options) {
        options.show_stages = true;
        return options;
    }
};

Shot clean_shot(double theta_rad = 0.3) {
    Setup setup;
    setup.preset = Preset::clean;
    Shot shot = draw_shot(setup, 4);
    shot.pose.theta_rad = theta_rad;
    return shot;
}

/// Returns the text between the start and the end of a group.
std::string group(const std::string& svg, const std::string& group_class, std::size_t from = 0) {
    const std::size_t begin = svg.find("<g class=\"" + group_class + "\"", from);
    if (begin == std::string::npos) return {};
    return svg.substr(begin, svg.find("</g>", begin) - begin);
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++n;
    }
    return n;
}

struct Mark {
    Vec2 pixel;
    char letter = ' ';
};

/// Returns the centres of the circles in the drawing, in pixel coordinates of the image.
std::vector<Mark> circles(const std::string& text, const GreyImage& image) {
    const double scale = 1200.0 / std::max(image.width_px, image.height_px);
    std::vector<Mark> marks;
    for (std::size_t at = text.find("<circle "); at != std::string::npos;
         at = text.find("<circle ", at + 1)) {
        Mark mark;
        if (std::sscanf(text.c_str() + at, "<circle cx=\"%lf\" cy=\"%lf\"", &mark.pixel.x,
                        &mark.pixel.y) != 2) {
            ADD_FAILURE() << text.substr(at, 60);
        }
        mark.pixel = {mark.pixel.x / scale - 0.5, mark.pixel.y / scale - 0.5};
        marks.push_back(mark);
    }
    return marks;
}

/// Returns the letters in the drawing with their positions, in pixel coordinates of the image.
std::vector<Mark> letters(const std::string& text, const GreyImage& image) {
    const double scale = 1200.0 / std::max(image.width_px, image.height_px);
    std::vector<Mark> marks;
    for (std::size_t at = text.find("<text "); at != std::string::npos;
         at = text.find("<text ", at + 1)) {
        Mark mark;
        if (std::sscanf(text.c_str() + at, "<text transform=\"translate(%lf %lf)", &mark.pixel.x,
                        &mark.pixel.y) != 2) {
            ADD_FAILURE() << text.substr(at, 60);
        }
        mark.pixel = {mark.pixel.x / scale - 0.5, mark.pixel.y / scale - 0.5};
        mark.letter = text[text.find('>', at) + 1];
        marks.push_back(mark);
    }
    return marks;
}

/// Returns the intersection closest to a pixel, in cells relative to the intersection of the pose.
FixedVec nearest_cell(const Shot& shot, Vec2 pixel) {
    const double spacing_mm = shot.page.pattern.spacing_mm;
    const Vec2 offset_mm = Projection(shot.camera, shot.pose).offset_from_pixel(pixel);
    return {static_cast<int>(std::lround(offset_mm.x / spacing_mm + shot.pose.fraction_x)),
            static_cast<int>(std::lround(offset_mm.y / spacing_mm + shot.pose.fraction_y))};
}

TEST(DrawFrame, shows_every_dot_where_it_is) {
    const Located located(render(clean_shot()));
    ASSERT_EQ(located.fix.status, Status::ok);
    const std::string svg = located.drawn();
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    const auto marks = circles(group(svg, "dots"), located.image);
    ASSERT_EQ(marks.size(), located.trace.dots.size());
    for (const Mark& mark : marks) {
        const auto u = static_cast<int>(std::lround(mark.pixel.x));
        const auto v = static_cast<int>(std::lround(mark.pixel.y));
        EXPECT_LT(located.image.view().row(v)[u], 150) << u << ", " << v;
    }
}

TEST(DrawFrame, connects_only_the_dots_that_were_connected) {
    // Uses the device attempt, because the first attempt finds the grid without connecting
    // neighbouring dots.
    DeviceOptions device;
    device.effort = Effort::device;
    const Located at_once(render(clean_shot()), device);
    EXPECT_GT(count(group(at_once.drawn(), "connections"), "<line "), 100u);
    // The second attempt measures the dots again, in another order. The connections between the
    // earlier dots are then invalid and are not drawn.
    dotpose::Setup setup;
    setup.preset = Preset::hard;
    for (std::uint64_t i = 0;; ++i) {
        ASSERT_LT(i, 50u) << "all frames were located at once";
        const GreyImage frame = render(draw_shot(setup, i));
        DeviceOptions once;
        once.effort = Effort::once;
        if (Located(frame, once).fix.status == Status::ok) continue;
        const Located located(frame);
        ASSERT_EQ(located.fix.status, Status::ok) << i;
        const std::string svg = located.drawn();
        EXPECT_EQ(count(group(svg, "connections"), "<line "), 0u) << i;
        EXPECT_EQ(circles(group(svg, "dots"), frame).size(), located.trace.dots.size());
        break;
    }
}

TEST(DrawFrame, draws_dots_where_the_lens_shows_them) {
    Shot shot = clean_shot();
    shot.camera.width_px = 376;
    shot.camera.height_px = 240;
    shot.camera.k = -4e-6;
    DeviceOptions options;
    options.lens = FixedLens::from_k(shot.camera.k);
    const Located located(render(shot), options);
    ASSERT_EQ(located.fix.status, Status::ok);
    const auto marks = circles(group(located.drawn(), "dots"), located.image);
    ASSERT_EQ(marks.size(), located.trace.dots.size());
    for (const Mark& mark : marks) {
        const auto u = static_cast<int>(std::lround(mark.pixel.x));
        const auto v = static_cast<int>(std::lround(mark.pixel.y));
        EXPECT_LT(located.image.view().row(v)[u], 160) << u << ", " << v;
    }
}

class DrawTurned : public testing::TestWithParam<int> {};

TEST_P(DrawTurned, letters_are_those_of_the_pattern) {
    const Shot shot = clean_shot(0.3 + GetParam() * 1.5707963267948966);
    const Located located(render(shot));
    ASSERT_EQ(located.fix.status, Status::ok);
    const std::string symbols = group(located.drawn(), "symbols");
    const auto marks = letters(symbols, located.image);
    EXPECT_GT(marks.size(), 150U);
    std::size_t errors = 0;
    for (const Mark& mark : marks) {
        const FixedVec step = nearest_cell(shot, mark.pixel);
        const Pattern& pattern = shot.page.pattern;
        const Place place = moved(pattern.code, {shot.pose.cell, pattern.section}, step.x, step.y);
        const char expected = letter(symbol_at(pattern.code, place.cell, place.section));
        if (std::tolower(mark.letter) != expected) ++errors;
    }
    // A misread dot has one or two wrong bits, so the number of misread dots is at most the number
    // of bit errors.
    EXPECT_LE(errors, static_cast<std::size_t>(located.fix.bit_errors));
    EXPECT_LE(errors, 1U);
    EXPECT_EQ(count(symbols, "stroke=\"#d500f9\""), errors);
}

TEST_P(DrawTurned, the_corner_is_at_the_position_that_the_head_names) {
    const Shot shot = clean_shot(0.3 + GetParam() * 1.5707963267948966);
    const Located located(render(shot));
    ASSERT_EQ(located.fix.status, Status::ok);
    const std::string svg = located.drawn();
    const std::size_t corner = svg.find("class=\"corner\"");
    ASSERT_NE(corner, std::string::npos);
    const auto marks = circles(svg.substr(svg.rfind("<circle", corner), 60), located.image);
    const FixedVec step = nearest_cell(shot, marks.at(0).pixel);
    const std::string position =
        std::to_string(static_cast<std::int64_t>(shot.pose.cell.x) + step.x) + ", " +
        std::to_string(static_cast<std::int64_t>(shot.pose.cell.y) + step.y);
    EXPECT_THAT(svg, HasSubstr("window decoded at " + position + "<"));
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, DrawTurned, testing::Range(0, 4));

TEST(DrawFrame, says_the_pose) {
    const Located located(render(clean_shot()));
    const std::string svg = located.drawn({.spacing_mm = 0.6, .title = "frame.png"});
    char x_mm[64];
    std::snprintf(x_mm, sizeof x_mm, ">%.3f mm<", located.fix.x_grid() * 0.6);
    EXPECT_THAT(svg, HasSubstr(x_mm));
    EXPECT_THAT(svg, HasSubstr(">frame.png<"));
}

TEST(DrawFrame, names_the_sheet) {
    const Located located(render(clean_shot()));
    EXPECT_THAT(located.drawn(), Not(HasSubstr("on sheet")));
    SheetEntry entry;
    entry.name = "table";
    const SheetPlace place{&entry, 12.5, 30.25, 0.5, {}};
    const std::string on_sheet = located.drawn({.place = place});
    EXPECT_THAT(on_sheet, HasSubstr(">x on the sheet<"));
    EXPECT_THAT(on_sheet, HasSubstr("font-weight=\"bold\">12.500 mm<"));
    EXPECT_THAT(on_sheet, HasSubstr(">on sheet table; in the pattern: x "));
    // In the world, y points up, so the expected value is 1 m - 30.25 mm.
    entry.world = WorldPose{2, 1, 0};
    const std::string in_world = located.drawn({.place = place});
    EXPECT_THAT(in_world, HasSubstr(">y in the world<"));
    EXPECT_THAT(in_world, HasSubstr("font-weight=\"bold\">2.012500 m<"));
    EXPECT_THAT(in_world, HasSubstr("font-weight=\"bold\">0.969750 m<"));
    EXPECT_THAT(in_world, HasSubstr(">on sheet table: x 12.500 mm, y 30.250 mm, "));
}

TEST(DrawFrame, says_why_there_is_no_fix) {
    const Located located(render(clean_shot()));
    Fix refused = located.fix;
    refused.status = Status::ambiguous_code;
    std::string reason;
    for (int i = 0; i < 40; ++i)
        reason += "word" + std::to_string(i) + ' ';
    const std::string svg = located.drawn({.fix = refused, .reason = reason});
    EXPECT_THAT(svg, HasSubstr("no fix: ambiguous_code"));
    EXPECT_THAT(svg, HasSubstr("word39<"));
    EXPECT_GE(count(svg, "class=\"reason\""), 3U);
    EXPECT_THAT(svg, Not(HasSubstr(" mm<")));
}

// A phone photo has 12 million pixels and shows thousands of dots.
TEST(DrawFrame, a_photo_stays_below_a_megabyte) {
    dotpose::Setup setup;
    setup.camera.width_px = 4032;
    setup.camera.height_px = 3024;
    Shot shot = draw_shot(setup, 1);
    const Located located(render(shot));
    ASSERT_EQ(located.fix.status, Status::ok);
    const std::string svg = located.drawn();
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    EXPECT_LT(svg.size(), 1'000'000U);
    EXPECT_GT(count(svg, "h0"), 2 * located.trace.dots.size() - 1);
}

TEST(DrawFrame, head_and_note_of_a_panel_do_not_overlap) {
    Shot shot = clean_shot();
    shot.camera.width_px = shot.camera.height_px = 188;
    const Located located(render(shot));
    for (const std::size_t letters : {5U, 60U, 250U}) {
        const std::string svg = located.drawn({.title = std::string(letters, 'n')});
        const std::regex note(R"re(font-size="([0-9.]+)" text-anchor="end" [^>]*>([^<]*)<)re");
        int notes = 0;
        for (std::sregex_iterator found(svg.begin(), svg.end(), note), end; found != end; ++found) {
            // DejaVu Sans is the widest of the fonts. In this font, the longer heading is 562 units
            // wide, and the width of a letter in a note is at most 0.634 times the font size. The
            // drawing is 1200 units wide.
            const double size = std::stod((*found)[1]);
            EXPECT_LT(562 + 0.634 * size * static_cast<double>((*found)[2].length()), 1200)
                << (*found)[2];
            ++notes;
        }
        EXPECT_EQ(notes, 2);
    }
}

TEST(DrawFrame, escapes_the_title) {
    const Located located(render(clean_shot()));
    const std::string svg = located.drawn({.title = "<a> & \"b\" \xff \x01 \xc3\xa9 \xed\xa0\x80"});
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    EXPECT_THAT(svg, HasSubstr("&lt;a&gt; &amp; &quot;b&quot; \xef\xbf\xbd \xef\xbf\xbd \xc3\xa9"));
    EXPECT_THAT(svg, Not(HasSubstr("\xff")));
    EXPECT_THAT(svg, Not(HasSubstr("\xed\xa0")));
}

TEST(DrawFrame, works_whatever_the_status) {
    // The first trace was filled by a located frame, and the second trace is empty.
    Located full(render(clean_shot()));
    Located empty(render(clean_shot()));
    empty.trace = {};
    for (int i = 0; i < kStatusCount; ++i) {
        const auto status = static_cast<Status>(i);
        full.trace.fix.status = status;
        empty.trace.fix.status = status;
        EXPECT_THAT(XmlCheck(full.drawn()).problem(), IsEmpty()) << name(status);
        EXPECT_THAT(XmlCheck(empty.drawn()).problem(), IsEmpty()) << name(status);
        if (status == Status::ok) continue;
        EXPECT_THAT(full.drawn(), HasSubstr(message(status)));
    }
}

TEST(DrawFrame, works_for_every_scene_without_a_fix) {
    for (const Scene scene : kScenes) {
        const Located located(render_scene(scene, clean_shot()));
        const std::string svg = located.drawn();
        EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty()) << name(scene);
        EXPECT_EQ(count(group(svg, "dots"), "<circle"), located.trace.dots.size()) << name(scene);
    }
}

TEST(DrawFrame, works_for_images_of_any_shape) {
    for (const auto& [width_px, height_px] : {std::pair(1, 1), {100'000, 1}, {1, 5000}, {64, 64}}) {
        GreyImage image{{}, width_px, height_px};
        image.pixels.resize(static_cast<std::size_t>(width_px) *
                            static_cast<std::size_t>(height_px));
        EXPECT_THAT(XmlCheck(Located(image).drawn()).problem(), IsEmpty());
    }
    EXPECT_THAT(XmlCheck(Located(GreyImage()).drawn()).problem(), IsEmpty());
}

TEST(DrawFrame, a_file_that_cannot_be_written_is_an_error) {
    const Located located(render(clean_shot()));
    EXPECT_THROW(draw_frame("no/such/folder/a.svg", located.image.view(), located.trace), Error);
    if (std::filesystem::exists("/dev/full")) {
        EXPECT_THROW(draw_frame("/dev/full", located.image.view(), located.trace), Error);
    }
}

Sheet a4() {
    Sheet sheet;
    sheet.columns = 394;
    sheet.rows = 565;
    sheet.width_mm = 210;
    sheet.height_mm = 297;
    sheet.origin_x_mm = sheet.origin_y_mm = 5;
    return sheet;
}

std::string drawn(const Sheet& sheet, const std::vector<PathPoint>& path) {
    std::ostringstream out;
    draw_path(out, sheet, path, "a <drive>");
    return out.str();
}

TEST(DrawPath, shows_fixes_and_gaps) {
    std::vector<PathPoint> path;
    for (int i = 0; i < 30; ++i) {
        const double mm = 10 + i;
        path.push_back({mm, mm, i % 3 != 0, mm + 0.003, mm - 0.004});
    }
    const std::string svg = drawn(a4(), path);
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    EXPECT_EQ(count(group(svg, "measured"), "<circle"), 20U);
    EXPECT_EQ(count(group(svg, "lost"), "<circle"), 10U);
    EXPECT_EQ(count(group(svg, "errors"), "<circle"), 20U);
    EXPECT_EQ(count(group(svg, "error-bars"), "<line"), 20U);
    EXPECT_THAT(svg, HasSubstr(">5.0 µm<"));  // the hypotenuse of 3 and 4 µm
}

TEST(DrawPath, works_without_points_without_fixes_and_without_errors) {
    EXPECT_THAT(XmlCheck(drawn(a4(), {})).problem(), IsEmpty());
    EXPECT_THAT(XmlCheck(drawn(a4(), {{10, 10, false, 0, 0}})).problem(), IsEmpty());
    const std::string perfect = drawn(a4(), {{10, 10, true, 10, 10}});
    EXPECT_THAT(XmlCheck(perfect).problem(), IsEmpty());
    EXPECT_THAT(perfect, Not(HasSubstr("nan")));
    Sheet wide = a4();
    std::swap(wide.width_mm, wide.height_mm);
    EXPECT_THAT(XmlCheck(drawn(wide, {{10, 10, true, 10, 10.001}})).problem(), IsEmpty());
}

}  // namespace
}  // namespace dotpose

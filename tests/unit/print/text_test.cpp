#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "files.hpp"

namespace dotpose {
namespace {

using print_test::TemporaryDirectory;

struct Vector {
    CodeVariant code;
    Cell origin;
    Section section;
    std::vector<std::string> rows;
};

const std::vector<Vector> kVectors = {
    {CodeVariant::anoto,
     {0, 0},
     {0, 0},
     {"uulluldu", "udlurrdr", "rrdruduu", "ruldllul", "ulurddur", "rldrduur", "dduuuuul",
      "ulurllrd"}},
    {CodeVariant::anoto,
     {122, 3219},
     {0, 0},
     {"ruldrdrr", "rdruudlr", "dllruuul", "lrlllrld", "dluruull", "luudlrrl", "lllulrll",
      "ulddurlr"}},
    {CodeVariant::anoto,
     {217, 1134},
     {0, 0},
     {"dddurddl", "rdddrudu", "rrluulul", "rdulduru", "ululuudu", "rlrrruud", "uuldddlr",
      "lrlddurr"}},
    {CodeVariant::anoto,
     {123456789, 400000000},
     {10, 2},
     {"lddruddd", "ldluudlr", "uddddull", "llruldrr", "ddrdlulr", "lrrllull", "rllulddr",
      "uulluuru"}},
    {CodeVariant::libdots,
     {122, 3219},
     {0, 0},
     {"ruldrdrr", "rdruudlr", "dllruuul", "lrlllrld", "dluruull", "luudlrrl", "lllulrll",
      "ulddurlr"}},
    {CodeVariant::microdots,
     {7, 3},
     {10, 2},
     {"drurrdll", "ruldldud", "llrddrdl", "ddullluu", "udurdurr", "urlllldd", "ldududuu",
      "dlllldrd"}},
};

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

TEST(write_text, writes_the_letters_of_the_code) {
    const TemporaryDirectory directory;
    for (const Vector& expected : kVectors) {
        SheetOptions options;
        options.pattern.code = expected.code;
        options.pattern.section = expected.section;
        options.origin = expected.origin;
        options.paper = {.width_mm = 20, .height_mm = 30};
        const Sheet sheet = make_sheet(options);
        write_sheet(sheet, directory / "sheet.txt");
        const auto lines = lines_of(print_test::read_file(directory / "sheet.txt"));
        ASSERT_EQ(lines.size(), static_cast<std::size_t>(sheet.rows));
        for (const std::string& line : lines) {
            EXPECT_EQ(line.size(), static_cast<std::size_t>(sheet.columns));
        }
        for (std::size_t row = 0; row < expected.rows.size(); ++row) {
            EXPECT_EQ(lines[row].substr(0, 8), expected.rows[row]) << "row " << row;
        }
    }
}

TEST(write_text, reaches_the_last_corner_of_the_code_plane) {
    // The test vector begins at x = 410815341, only 7 columns before the end of the plane. The
    // sheet begins one column earlier and contains the first 7 of the 8 columns of the vector.
    const std::vector<std::string> expected = {"urrrduu", "urdrllr", "lrlrldl", "drdddur",
                                               "drdurdr", "lulrurr", "dlrlrdr", "rrdllld"};
    const TemporaryDirectory directory;
    Sheet sheet = make_sheet({});
    sheet.pattern.section = {.u = 62, .v = 1};
    sheet.columns = 8;
    sheet.rows = 8;
    sheet.origin = {.x = kPositionsPerAxis - 8, .y = 5};
    write_sheet(sheet, directory / "sheet.txt");
    const auto lines = lines_of(print_test::read_file(directory / "sheet.txt"));
    ASSERT_EQ(lines.size(), 8U);
    for (std::size_t row = 0; row < 8; ++row)
        EXPECT_EQ(lines[row].substr(1), expected[row]);
}

}  // namespace
}  // namespace dotpose

// Prints into a sheet file and locates with it.
#pragma once

#include <string>

#include "locate_command.hpp"

namespace dotpose::test {

class SheetsCommand : public LocateCommand {
  protected:
    int print(const std::string& arguments) { return ToolCommand::run("print " + arguments); }
    json sheets() const { return json::parse(read_file(directory_ / "sheets.json"))["sheets"]; }

    /// As a user does it, with an editor.
    template <typename Edit>
    void edit_sheet(std::size_t index, const Edit& edit) const {
        json document = json::parse(read_file(directory_ / "sheets.json"));
        edit(document["sheets"].at(index));
        write("sheets.json", document.dump());
    }

    /// One record, of the image given.
    json locate_with_sheets(const GreyImage& image) {
        write_pgm(directory_ / "frame.pgm", image.view());
        run("--sheets sheets.json frame.pgm");
        EXPECT_EQ(exit_code_, 0) << errors_;
        return records().at(0);
    }
};

}  // namespace dotpose::test

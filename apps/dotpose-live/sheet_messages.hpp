/// Values of the sheet topics. docs/web.md describes the topics.
#pragma once

#include <deque>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "sheet_edits.hpp"
#include "stitch_job.hpp"

namespace dotpose::cli {

/// Reply to a command from a web page.
struct SheetAnswer {
    std::string id = {};  ///< identifier that the page chose for the command
    bool is_ok = false;
    std::string message = {};
    std::string name = {};  ///< name of a new sheet, or empty
    std::string url = {};   ///< path of a file to download, or empty
};

/// Returns the sheets in the file, and descriptions of the edits that can be undone or redone.
nlohmann::json sheets_message(const SheetEdits& edits, bool may_edit);
nlohmann::json answers_message(const std::deque<SheetAnswer>& answers);
/// Returns the state of a measurement. `progress` is null if no measurement is running.
nlohmann::json stitch_message(const StitchJob::Progress* progress);

}  // namespace dotpose::cli

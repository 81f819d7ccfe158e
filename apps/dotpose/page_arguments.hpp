/// Command-line options of a page in the browser. dotpose-live serves the page.
#pragma once

#include <string>

#include "command_line.hpp"

namespace dotpose::cli {

struct PageArguments {
    std::string address;     ///< "[ADDRESS:]PORT"; empty: no page
    std::string token_file;  ///< empty: no file

    /// Adds --web and --web-token-file.
    void add_to(Command& command);
};

}  // namespace dotpose::cli

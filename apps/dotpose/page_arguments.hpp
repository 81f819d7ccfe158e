/// Command-line options for the web page that dotpose-live serves.
#pragma once

#include <string>

#include "command_line.hpp"

namespace dotpose::cli {

struct PageArguments {
    std::string address;     ///< "[ADDRESS:]PORT" of the page, or empty for no page
    std::string token_file;  ///< path of the token file, or empty for none

    /// Adds --web and --web-token-file.
    void add_to(Command& command);
};

}  // namespace dotpose::cli

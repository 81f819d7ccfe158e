/// Command-line options of the page in the browser.
#pragma once

#include <optional>
#include <string>

#include "command_line.hpp"
#include "serve/server.hpp"

namespace dotpose::cli {

class WebArguments {
  public:
    /// Adds --web and --web-token-file.
    void add_to(Command& command);

    /// Returns true if --web is given.
    bool is_wanted() const { return !address_.empty(); }

    /// Returns the options of the server, without pages, or none without --web. Outside of the
    /// loopback interface, makes a token if no file contains one. Throws BadArgument or Error if
    /// the options are invalid.
    std::optional<serve::ServerOptions> options() const;

    const std::string& token_file() const { return token_file_; }

  private:
    std::string address_;
    std::string token_file_;
};

}  // namespace dotpose::cli

/// Command-line options for a web page.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "page_arguments.hpp"
#include "serve/server.hpp"

namespace dotpose::cli {

class WebArguments {
  public:
    explicit WebArguments(PageArguments page = {}) : page_(std::move(page)) {}

    /// Adds --web and --web-token-file.
    void add_to(Command& command) { page_.add_to(command); }

    /// Returns true if --web is given.
    bool is_wanted() const { return !page_.address.empty(); }

    /// Returns the options for the server, or nullopt if --web is not given. The caller must add
    /// the pages. Creates a token if the server is reachable from other computers and no token file
    /// is given. Throws BadArgument or Error if the options are invalid.
    std::optional<serve::ServerOptions> options() const;

    const std::string& token_file() const { return page_.token_file; }

  private:
    PageArguments page_;
};

}  // namespace dotpose::cli

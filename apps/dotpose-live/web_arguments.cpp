#include "web_arguments.hpp"

#include "dotpose/files/error.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

std::optional<serve::ServerOptions> WebArguments::options() const {
    if (page_.address.empty()) {
        if (!page_.token_file.empty())
            throw BadArgument("--web-token-file needs --web [ADDRESS:]PORT");
        return std::nullopt;
    }
    serve::ServerOptions options;
    options.address = serve::parse_address(page_.address);
    options.notify = [](const std::string& message) { notify(message); };
    if (!page_.token_file.empty()) {
        options.token = serve::read_token(page_.token_file);
    } else if (!options.address.is_loopback()) {
        options.token = serve::make_token();
    }
    return options;
}

}  // namespace dotpose::cli

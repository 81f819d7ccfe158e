#include "web_arguments.hpp"

#include "dotpose/files/error.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

void WebArguments::add_to(Command& command) {
    command
        .add_option("--web", address_,
                    "Serve a page that shows the run; without ADDRESS, only on this computer")
        ->type_name("[ADDRESS:]PORT");
    command
        .add_option("--web-token-file", token_file_,
                    "File with the token that the page of --web requires; an address other than "
                    "localhost always requires a token, by default a new one")
        ->type_name("FILE");
}

std::optional<serve::ServerOptions> WebArguments::options() const {
    if (address_.empty()) {
        if (!token_file_.empty()) throw BadArgument("--web-token-file needs --web [ADDRESS:]PORT");
        return std::nullopt;
    }
    serve::ServerOptions options;
    options.address = serve::parse_address(address_);
    options.tell = [](const std::string& message) { tell(message); };
    if (!token_file_.empty()) {
        options.token = serve::read_token(token_file_);
    } else if (!options.address.is_loopback()) {
        options.token = serve::make_token();
    }
    return options;
}

}  // namespace dotpose::cli

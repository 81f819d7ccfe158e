#include "page_arguments.hpp"

namespace dotpose::cli {

void PageArguments::add_to(Command& command) {
    command
        .add_option("--web", address,
                    "Serve a page that shows the run; without ADDRESS, only on this computer")
        ->type_name("[ADDRESS:]PORT");
    command
        .add_option("--web-token-file", token_file,
                    "File with the token that the page of --web requires; an address other than "
                    "localhost always requires a token, by default a new one")
        ->type_name("FILE");
}

}  // namespace dotpose::cli

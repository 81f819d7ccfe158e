#include "commands.hpp"

namespace dotpose::cli {

void add_live_commands(Command& app, int& exit_code) {
    add_watch(app, exit_code);
    add_fleet(app, exit_code);
}

}  // namespace dotpose::cli

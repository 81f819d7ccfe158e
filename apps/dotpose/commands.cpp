#include "commands.hpp"

namespace dotpose::cli {

void add_commands(Command& app, int& exit_code) {
    add_locate(app, exit_code);
    add_print(app, exit_code);
    add_overlay(app, exit_code);
    add_sheets(app, exit_code);
    add_simulate(app, exit_code);
    add_evaluate(app, exit_code);
    add_check_print(app, exit_code);
    add_calibrate(app, exit_code);
    add_optics(app, exit_code);
    add_listen(app, exit_code);
    add_replay(app, exit_code);
    add_ink(app, exit_code);
}

}  // namespace dotpose::cli

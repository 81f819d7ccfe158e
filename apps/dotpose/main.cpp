#include "commands.hpp"
#include "tool_main.hpp"

int main(int argc, char** argv) {
    return dotpose::cli::tool_main(argc, argv, [](CLI::App& app, int& exit_code) {
        using namespace dotpose::cli;
        add_locate(app, exit_code);
        add_print(app, exit_code);
        add_overlay(app, exit_code);
        add_simulate(app, exit_code);
        add_evaluate(app, exit_code);
        add_check_print(app, exit_code);
        add_calibrate(app, exit_code);
        add_optics(app, exit_code);
        add_listen(app, exit_code);
        add_replay(app, exit_code);
        add_live(app);
    });
}

#include "../dotpose/commands.hpp"
#include "commands.hpp"
#include "tool_main.hpp"

int main(int argc, char** argv) {
    return dotpose::cli::tool_main(argc, argv, [](dotpose::cli::Command& app, int& exit_code) {
        using namespace dotpose::cli;
        add_live_commands(app, exit_code);
        // Commands that `dotpose` also implements. `dotpose` runs them in this program if they use
        // a camera, a video or a broker.
        add_locate(app, exit_code);
        add_calibrate(app, exit_code);
        add_evaluate(app, exit_code);
        add_simulate(app, exit_code);
        add_listen(app, exit_code);
    });
}

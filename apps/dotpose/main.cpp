#include "commands.hpp"
#include "tool_main.hpp"

int main(int argc, char** argv) {
    return dotpose::cli::tool_main(argc, argv, [](dotpose::cli::Command& app, int& exit_code) {
        dotpose::cli::add_commands(app, exit_code);
        dotpose::cli::add_live(app);
    });
}

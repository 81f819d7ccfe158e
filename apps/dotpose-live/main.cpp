#include "commands.hpp"
#include "tool_main.hpp"

int main(int argc, char** argv) {
    return dotpose::cli::tool_main(argc, argv, [](CLI::App& app, int& exit_code) {
        dotpose::cli::add_watch(app, exit_code);
        dotpose::cli::add_fleet(app, exit_code);
    });
}

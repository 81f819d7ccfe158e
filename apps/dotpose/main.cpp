#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/error.hpp"

namespace {

int run(int argc, char** argv) {
    using namespace dotpose::cli;
    remember_command_line(argc, argv);
    CLI::App app("Locates a camera on a sheet printed with a dot position code.", "dotpose");
    app.set_version_flag("--version", "dotpose " DOTPOSE_VERSION);
    app.require_subcommand(1);
    int exit_code = 0;
    add_locate(app, exit_code);
    add_print(app, exit_code);
    add_overlay(app, exit_code);
    add_simulate(app, exit_code);
    add_evaluate(app, exit_code);
    add_check_print(app, exit_code);
    add_calibrate(app, exit_code);
    add_optics(app, exit_code);
    try {
        app.parse(argc, argv);
        return exit_code;
    } catch (const CLI::Success& request) {
        return app.exit(request);  // --help and --version
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "dotpose: {}\nTry: dotpose --help\n", error.what());
        return kExitUsage;
    } catch (const dotpose::BadArgument& error) {
        fmt::print(stderr, "dotpose: {}\n", error.what());
        return kExitUsage;
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fputs("dotpose: ", stderr);
        std::fputs(error.what(), stderr);
        std::fputs("\n", stderr);
        return dotpose::cli::kExitFailed;
    }
}

#include "tool_main.hpp"

#include <cstdio>
#include <exception>

#include <fmt/core.h>

#include "common.hpp"
#include "dotpose/error.hpp"
#include "exit_codes.hpp"

namespace dotpose::cli {
namespace {

int run(int argc, char** argv, const std::function<void(CLI::App& app, int& exit_code)>& add) {
    remember_command_line(argc, argv);
    CLI::App app("Locates a camera on a sheet printed with a dot position code.", "dotpose");
    app.set_version_flag("--version", "dotpose " DOTPOSE_VERSION);
    app.require_subcommand(1);
    int exit_code = 0;
    add(app, exit_code);
    try {
        app.parse(argc, argv);
        return exit_code;
    } catch (const CLI::Success& request) {
        return app.exit(request);  // --help and --version
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "dotpose: {}\nTry: dotpose --help\n", error.what());
        return kExitUsage;
    } catch (const BadArgument& error) {
        fmt::print(stderr, "dotpose: {}\n", error.what());
        return kExitUsage;
    }
}

}  // namespace

int tool_main(int argc, char** argv,
              const std::function<void(CLI::App& app, int& exit_code)>& add) noexcept {
    try {
        return run(argc, argv, add);
    } catch (const std::exception& error) {
        std::fputs("dotpose: ", stderr);
        std::fputs(error.what(), stderr);
        std::fputs("\n", stderr);
        return kExitFailed;
    }
}

}  // namespace dotpose::cli

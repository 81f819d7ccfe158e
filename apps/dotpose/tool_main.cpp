#include "tool_main.hpp"

#include <cstdio>
#include <exception>

#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "exit_codes.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

int run(int argc, char** argv, const std::function<void(CLI::App& app, int& exit_code)>& add) {
    remember_command_line(argc, argv);
    CLI::App app("Locates a camera on a sheet printed with a dot position code.", "dotpose");
    app.set_version_flag("--version", "dotpose " DOTPOSE_VERSION);
    app.require_subcommand(1);
    int exit_code = 0;
    add(app, exit_code);
    refuse_non_finite_numbers(app);
    try {
        app.parse(argc, argv);
        return exit_code;
    } catch (const CLI::Success& request) {
        return app.exit(request);  // --help and --version
    } catch (const CLI::ParseError& error) {
        tell(error.what());
        std::fputs("Try: dotpose --help\n", stderr);
        return kExitUsage;
    } catch (const BadArgument& error) {
        tell(error.what());
        return kExitUsage;
    }
}

}  // namespace

int tool_main(int argc, char** argv,
              const std::function<void(CLI::App& app, int& exit_code)>& add) noexcept {
    try {
        return run(argc, argv, add);
    } catch (const std::exception& error) {
        tell(error.what());
        return kExitFailed;
    }
}

}  // namespace dotpose::cli

#include "tool_main.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "choices.hpp"
#include "common.hpp"
#include "completion.hpp"
#include "dotpose/files/error.hpp"
#include "exit_codes.hpp"
#include "system/process.hpp"
#include "terminal_text.hpp"
#include "usage_errors.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kVersion = "dotpose " DOTPOSE_VERSION;

/// Commands that the help suggests to new users.
constexpr const char* kFirstSteps =
    "  dotpose print -o sheet.pdf   a sheet of dots; print it at 100 %\n"
    "  dotpose locate photo.jpg     the position of a photo on the sheet\n"
    "  dotpose watch 0              the position of a camera on the sheet, live\n";

/// Returns help text with the locations of the documents and the examples.
std::string places_of_documents() {
    std::error_code failed;
    const auto folder = (system::program_folder() / DOTPOSE_DOCUMENTS_FROM_TOOL).lexically_normal();
    if (!std::filesystem::is_directory(folder, failed))
        return "Documents: README.md and docs/ of the source; examples in C++: examples/";
    return fmt::format("Documents: {0}/README.md and {0}/docs\nExamples in C++: {0}/examples",
                       folder.string());
}

/// Adds the commands `help` and `version`. The callback of `help locate` only stores the words of
/// `locate --help` in `help_words`, in reverse order as CLI11 expects them. The caller then parses
/// these words. `help_words` must outlive the app.
void add_help_and_version(Command& app, std::vector<std::string>& help_words) {
    std::vector<std::string> names;
    for (const Command* command : app.get_all_subcommands())
        names.push_back(command->get_name());
    const auto topic = std::make_shared<std::string>();
    Command* help = app.add_subcommand(kHelpCommand, "Show the options of a command");
    help->add_option("command", *topic, "The command; without it, all commands are listed")
        ->type_name("NAME")
        ->check(one_of(names));
    help->callback([topic, &help_words] {
        help_words = {"--help"};
        if (!topic->empty()) help_words.push_back(*topic);
    });
    app.add_subcommand("version", "Print the version")->callback([] {
        fmt::print("{}\n", kVersion);
    });
}

int run(int argc, const char* const* argv, const AddCommands& add) {
    remember_command_line(argc, argv);
    Command app("Locates a camera on a sheet printed with a dot position code.", "dotpose");
    app.set_version_flag("--version", kVersion);
    app.require_subcommand(1);
    int exit_code = 0;
    add(app, exit_code);
    refuse_non_finite_numbers(app);
    std::vector<std::string> help_words;
    add_help_and_version(app, help_words);
    if (argc > 1 && std::string_view(argv[1]) == kComplete) {
        print_completions(app, {argv + 2, argv + argc});
        return 0;
    }
    for (Command* command : app.get_all_subcommands()) {
        command->group("Commands");
        std::vector<Command*> with_options = command->get_all_subcommands();
        with_options.push_back(command);
        for (Command* each : with_options) {
            each->preparse_callback(
                [each, argc, argv](std::size_t) { require_two_hyphens(*each, argc, argv); });
        }
    }
    app.footer(fmt::format(
        "First steps:\n{}\ndotpose COMMAND --help has all options and more examples.\n{}",
        kFirstSteps, places_of_documents()));
    try {
        app.parse(argc, argv);
        if (!help_words.empty()) app.parse(help_words);
        return exit_code;
    } catch (const UsageError& error) {
        notify_failure(usage_error(app, error));
    } catch (const BadArgument& error) {
        notify_failure(error.what());
    }
    write_to_stderr("Try: " + help_command(app) + "\n");
    return kExitUsage;
}

}  // namespace

int tool_main(int argc, char** argv, const AddCommands& add) noexcept {
    try {
        const std::vector<std::string> arguments = system::start_program(argc, argv);
        std::vector<const char*> words;
        for (const std::string& argument : arguments)
            words.push_back(argument.c_str());
        return run(static_cast<int>(words.size()), words.data(), add);
    } catch (const std::exception& error) {
        notify_failure(error.what());
        return kExitFailed;
    }
}

}  // namespace dotpose::cli

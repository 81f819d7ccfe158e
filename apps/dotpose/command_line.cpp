#include "command_line.hpp"

#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace dotpose::cli {
namespace {

/// Wraps `text` into lines that start at column `indent` and end at column 100 or earlier.
std::string wrapped(const std::string& text, std::size_t indent) {
    constexpr std::size_t kColumns = 100;
    std::string lines(indent, ' ');
    std::size_t column = indent;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (column > indent && column + 1 + word.size() > kColumns) {
            lines += '\n' + std::string(indent, ' ');
            column = indent;
        } else if (column > indent) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
    }
    return lines + '\n';
}

std::string joined(const std::vector<std::string>& texts, const char* separator) {
    std::string all;
    for (const std::string& text : texts)
        all += (all.empty() ? "" : separator) + text;
    return all;
}

std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    for (const CLI::Option* option : options)
        names.push_back(option->get_name());
    return names;
}

/// Formats the help in two columns: the option with its value, and the description. The description
/// is followed, in parentheses, by the default value and by the options that the option requires or
/// excludes.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() {
        label("SUBCOMMAND", "COMMAND");
        label("Positionals", "Arguments");
    }

    std::string make_option(const CLI::Option* option, bool is_argument) const override {
        const std::string left = "  " + name_and_value(*option, is_argument);
        const std::string right = wrapped(description(*option), get_column_width());
        if (left.size() >= get_column_width()) return left + '\n' + right;
        return left + right.substr(left.size());
    }

  private:
    static std::string name_and_value(const CLI::Option& option, bool is_argument) {
        if (is_argument) return option.get_name(true, false);
        std::string text = CLI::detail::find_and_replace(option.get_name(false, true), ",", ", ");
        const bool has_value = option.get_items_expected_max() > 0;
        const bool is_list =
            option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
        if (has_value) text += ' ' + option.get_type_name();
        return is_list ? text + "..." : text;
    }

    static std::string description(const CLI::Option& option) {
        std::vector<std::string> notes;
        if (option.get_required()) notes.push_back("required");
        if (!option.get_default_str().empty())
            notes.push_back("default: " + option.get_default_str());
        if (!option.get_needs().empty())
            notes.push_back("only with " + joined(names_of(option.get_needs()), ", "));
        if (!option.get_excludes().empty())
            notes.push_back("not with " + joined(names_of(option.get_excludes()), ", "));
        if (notes.empty()) return option.get_description();
        return option.get_description() + " (" + joined(notes, "; ") + ")";
    }
};

template <typename Number>
Validator range(Number min, Number max) {
    const CLI::Range range(min, max);
    return Validator([range, min, max](const std::string& value) -> std::string {
        std::string tried = value;
        if (range(tried).empty()) return {};
        return fmt::format("'{}' is not a number from {} to {}", value, min, max);
    });
}

/// Splits a string at the first occurrence of `separator`.
std::pair<std::string, std::string> split(const std::string& text, std::string_view separator) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos) return {text, ""};
    return {text.substr(0, at), text.substr(at + separator.size())};
}

/// Returns a user-friendly message for a CLI11 error. The original message contains type names and
/// counts. The function parses it to extract the option and its value, because CLI11 does not
/// provide them separately.
std::string message_of(const CLI::ParseError& error) {
    const std::string text = error.what();
    if (text == "A subcommand is required") return "no command given";
    if (text == "--out is required") return "--out is required: name the file to write, -o FILE";
    const std::string& kind = error.get_name();
    if (kind == "ExcludesError") {
        const auto [option, other] = split(text, " excludes ");
        return fmt::format("{} and {} cannot be given together", option, other);
    }
    if (kind == "ConversionError") {
        const auto [option, value] = split(split(text, "Could not convert: ").second, " = ");
        return fmt::format("{}: '{}' is not a valid number", option, value);
    }
    if (kind == "ArgumentMismatch") {
        const auto [option, problem] = split(text, ": ");
        if (problem.ends_with("missing")) return option + " requires a value";
        // `problem` has the form "At least 2 required but received 1".
        std::istringstream words(problem);
        std::string word, wanted, given;
        words >> word >> word >> wanted >> word >> word >> word >> given;
        return fmt::format("{} takes {}, not {}", option,
                           wanted == "1" ? "one value" : wanted + " values", given);
    }
    return text;
}

/// Calls `parse` and converts exceptions thrown by CLI11 to UsageError. Returns false if the help
/// or the version was printed.
bool parsed(CLI::App& app, const std::function<void()>& parse) {
    try {
        parse();
        return true;
    } catch (const CLI::Success& request) {
        app.exit(request);
        return false;
    } catch (const CLI::ParseError& error) {
        throw UsageError(message_of(error));
    }
}

}  // namespace

bool parse_number(const std::string& text, double& number) {
    return CLI::detail::lexical_cast(text, number);
}

bool parse_number(const std::string& text, int& number) {
    return CLI::detail::lexical_cast(text, number);
}

Range::Range(int min, int max) : Validator(range(min, max)) {}
Range::Range(double min, double max) : Validator(range(min, max)) {}
Range::Range(std::uint64_t min, std::uint64_t max) : Validator(range(min, max)) {}

Option* Option::type_name(const std::string& name) {
    option_->type_name(name);
    return this;
}

Option* Option::description(const std::string& help) {
    option_->description(help);
    return this;
}

Option* Option::default_str(const std::string& text) {
    option_->default_str(text);
    return this;
}

Option* Option::capture_default_str() {
    option_->capture_default_str();
    return this;
}

Option* Option::required() {
    option_->required();
    return this;
}

Option* Option::needs(Option* other) {
    option_->needs(other->option_);
    return this;
}

Option* Option::excludes(Option* other) {
    option_->excludes(other->option_);
    return this;
}

Option* Option::expected(int values) {
    option_->expected(values);
    return this;
}

Option* Option::delimiter(char separator) {
    option_->delimiter(separator);
    return this;
}

Option* Option::check(const Check& check) {
    option_->check(check);
    return this;
}

Option* Option::check(const Validator& validator) {
    option_->check(validator.check_);
    if (!validator.choices_.empty()) choices_ = validator.choices_;
    return this;
}

std::size_t Option::count() const {
    return option_->count();
}

std::string Option::get_name() const {
    return option_->get_name();
}

std::string Option::get_type_name() const {
    return option_->get_type_name();
}

std::string Option::get_description() const {
    return option_->get_description();
}

std::vector<std::string> Option::get_snames() const {
    return option_->get_snames();
}

std::vector<std::string> Option::get_lnames() const {
    return option_->get_lnames();
}

bool Option::get_positional() const {
    return option_->get_positional();
}

int Option::get_items_expected_max() const {
    return option_->get_items_expected_max();
}

Command::Command(const std::string& what, const std::string& name)
    : app_(std::make_shared<CLI::App>(what, name)) {
    app_->formatter(std::make_shared<HelpFormatter>());
}

Command* Command::add_subcommand(const std::string& name, const std::string& what) {
    return command_of(app_->add_subcommand(name, what));
}

template <typename Value>
Option* Command::add_option(const std::string& names, Value& value, const std::string& help) {
    return option_of(app_->add_option(names, value, help));
}

template <typename Value>
Option* Command::add_option_function(const std::string& names,
                                     const std::function<void(const Value&)>& store,
                                     const std::string& help) {
    return option_of(app_->add_option_function<Value>(names, store, help));
}

Option* Command::add_flag(const std::string& names, bool& is_given, const std::string& help) {
    return option_of(app_->add_flag(names, is_given, help));
}

Option* Command::add_flag_callback(const std::string& names, const std::function<void()>& store,
                                   const std::string& help) {
    return option_of(app_->add_flag_callback(names, store, help));
}

Command* Command::callback(const std::function<void()>& run) {
    app_->callback(run);
    return this;
}

Command* Command::preparse_callback(const std::function<void(std::size_t)>& run) {
    app_->preparse_callback(run);
    return this;
}

Command* Command::footer(const std::string& text) {
    app_->footer(text);
    return this;
}

Command* Command::group(const std::string& name) {
    app_->group(name);
    return this;
}

Command* Command::require_subcommand(int number) {
    app_->require_subcommand(number);
    return this;
}

Command* Command::require_subcommand(int min, int max) {
    app_->require_subcommand(static_cast<std::size_t>(min), static_cast<std::size_t>(max));
    return this;
}

Command* Command::prefix_command() {
    app_->prefix_command();
    return this;
}

Command* Command::set_help_flag() {
    app_->set_help_flag();
    return this;
}

Command* Command::set_version_flag(const std::string& name, const std::string& version) {
    app_->set_version_flag(name, version);
    return this;
}

bool Command::parse(int argc, const char* const* argv) {
    return parsed(*app_, [&] { app_->parse(argc, argv); });
}

bool Command::parse(std::vector<std::string> words) {
    return parsed(*app_, [&] { app_->parse(std::move(words)); });
}

std::string Command::get_name() const {
    return app_->get_name();
}

std::string Command::get_description() const {
    return app_->get_description();
}

std::size_t Command::count(const std::string& option) const {
    return app_->count(option);
}

Option* Command::get_option(const std::string& name) const {
    return option_of(app_->get_option(name));
}

Option* Command::get_option_no_throw(const std::string& name) const {
    CLI::Option* option = app_->get_option_no_throw(name);
    return option == nullptr ? nullptr : option_of(option);
}

std::vector<Option*> Command::get_options() const {
    std::vector<Option*> options;
    for (CLI::Option* option : app_->get_options())
        options.push_back(option_of(option));
    return options;
}

std::vector<Command*> Command::get_all_subcommands() const {
    std::vector<Command*> commands;
    for (CLI::App* app : app_->get_subcommands([](CLI::App*) { return true; }))
        commands.push_back(command_of(app));
    return commands;
}

std::vector<Command*> Command::get_parsed_subcommands() const {
    std::vector<Command*> commands;
    for (CLI::App* app : app_->get_subcommands())
        commands.push_back(command_of(app));
    return commands;
}

std::vector<std::string> Command::remaining() const {
    return app_->remaining();
}

Option* Command::option_of(CLI::Option* option) const {
    return &options_.try_emplace(option, *option).first->second;
}

Command* Command::command_of(CLI::App* app) const {
    std::unique_ptr<Command>& command = commands_[app];
    if (!command) command = std::make_unique<Command>(app_->get_subcommand_ptr(app));
    return command.get();
}

// Instantiations for all supported types of option values.
template <typename Value>
using Store = std::function<void(const Value&)>;
using Text = const std::string&;
template Option* Command::add_option(Text, std::string&, Text);
template Option* Command::add_option(Text, std::vector<std::string>&, Text);
template Option* Command::add_option(Text, int&, Text);
template Option* Command::add_option(Text, std::optional<int>&, Text);
template Option* Command::add_option(Text, unsigned&, Text);
template Option* Command::add_option(Text, std::int64_t&, Text);
template Option* Command::add_option(Text, std::uint64_t&, Text);
template Option* Command::add_option(Text, float&, Text);
template Option* Command::add_option(Text, double&, Text);
template Option* Command::add_option(Text, std::optional<double>&, Text);
template Option* Command::add_option(Text, std::vector<int>&, Text);
template Option* Command::add_option(Text, std::vector<double>&, Text);
template Option* Command::add_option_function(Text, const Store<std::string>&, Text);
template Option* Command::add_option_function(Text, const Store<int>&, Text);
template Option* Command::add_option_function(Text, const Store<double>&, Text);

}  // namespace dotpose::cli

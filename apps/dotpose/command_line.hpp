/// Command-line commands and options: a thin wrapper around CLI11. The member functions have the
/// same names as in CLI11.
///
/// Only command_line.cpp includes the CLI11 header, because the header adds ten seconds to the
/// compile time of a source file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dotpose::cli {

/// An error in the command line.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An invalid option value.
class ValidationError : public UsageError {
  public:
    ValidationError(const std::string& option, const std::string& why)
        : UsageError(option + ": " + why) {}
};

/// Parses a number in the format of option values. Returns true if the whole string is a number.
bool parse_number(const std::string& text, double& number);
bool parse_number(const std::string& text, int& number);

/// Function that returns the reason why a value is invalid, or an empty string for a valid value.
using Check = std::function<std::string(const std::string& value)>;

/// Checks option values. `choices` lists the valid values if there are only a few, and is empty
/// otherwise.
class Validator {
  public:
    explicit Validator(Check check, std::vector<std::string> choices = {})
        : check_(std::move(check)), choices_(std::move(choices)) {}

  private:
    friend class Option;
    Check check_;
    std::vector<std::string> choices_;
};

/// Accepts numbers in the closed range [min, max].
class Range : public Validator {
  public:
    Range(int min, int max);
    Range(double min, double max);
    Range(std::uint64_t min, std::uint64_t max);
};

/// An option of a command, or a positional argument. Commands own their options.
class Option {
  public:
    explicit Option(CLI::Option& option) : option_(&option) {}
    Option(const Option&) = delete;
    Option& operator=(const Option&) = delete;

    Option* type_name(const std::string& name);
    Option* description(const std::string& help);
    Option* default_str(const std::string& text);
    Option* capture_default_str();
    Option* required();
    Option* needs(Option* other);
    Option* excludes(Option* other);
    Option* expected(int values);
    Option* delimiter(char separator);
    Option* check(const Check& check);
    Option* check(const Validator& validator);

    std::size_t count() const;  ///< number of times the option occurs on the command line

    std::string get_name() const;  ///< longest name, with hyphens
    std::string get_type_name() const;
    std::string get_description() const;
    std::vector<std::string> get_snames() const;  ///< one-letter names, without the hyphen
    std::vector<std::string> get_lnames() const;  ///< long names, without the hyphens
    bool get_positional() const;
    int get_items_expected_max() const;  ///< maximum number of values, or 0 for a flag
    /// Returns the valid values if there are only a few, and an empty list otherwise.
    const std::vector<std::string>& choices() const { return choices_; }

  private:
    CLI::Option* option_;
    std::vector<std::string> choices_;
};

/// A command, or the program itself. Owns its subcommands and its options.
class Command {
  public:
    /// Creates a program. If `name` is empty, the program is named after its executable file.
    explicit Command(const std::string& what = "", const std::string& name = "");
    /// Creates a subcommand.
    explicit Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    Command* add_subcommand(const std::string& name, const std::string& what = "");
    /// Adds an option that stores its value in a variable. The variable must outlive the command.
    /// The supported types are listed at the end of command_line.cpp.
    template <typename Value>
    Option* add_option(const std::string& names, Value& value, const std::string& help = "");
    /// Adds an option that passes its value to a function. The supported types are listed at the
    /// end of command_line.cpp.
    template <typename Value>
    Option* add_option_function(const std::string& names,
                                const std::function<void(const Value&)>& store,
                                const std::string& help = "");
    Option* add_flag(const std::string& names, bool& is_given, const std::string& help = "");
    Option* add_flag_callback(const std::string& names, const std::function<void()>& store,
                              const std::string& help = "");

    Command* callback(const std::function<void()>& run);
    Command* preparse_callback(const std::function<void(std::size_t)>& run);
    Command* footer(const std::string& text);
    Command* group(const std::string& name);
    Command* require_subcommand(int number);
    Command* require_subcommand(int min, int max);
    Command* prefix_command();  ///< makes the command accept any words after its name
    Command* set_help_flag();   ///< removes --help
    Command* set_version_flag(const std::string& name, const std::string& version);

    /// Parses the arguments of `main` and runs the callbacks of the commands that were given.
    /// Returns false if the help or the version was printed. Throws UsageError if the arguments are
    /// invalid.
    bool parse(int argc, const char* const* argv);
    /// Like the first overload, but takes a list of words, in reverse order and without the program
    /// name.
    bool parse(std::vector<std::string> words);

    std::string get_name() const;
    std::string get_description() const;
    std::size_t count(const std::string& option) const;
    Option* get_option(const std::string& name) const;           ///< throws if not found
    Option* get_option_no_throw(const std::string& name) const;  ///< null if not found
    std::vector<Option*> get_options() const;
    std::vector<Command*> get_all_subcommands() const;
    std::vector<Command*> get_parsed_subcommands() const;
    std::vector<std::string> remaining() const;  ///< words that the parser did not recognise

  private:
    Option* option_of(CLI::Option* option) const;
    Command* command_of(CLI::App* app) const;

    std::shared_ptr<CLI::App> app_;
    // Wrappers around CLI11 options and commands, created on first use.
    mutable std::map<CLI::Option*, Option> options_;
    mutable std::map<CLI::App*, std::unique_ptr<Command>> commands_;
};

}  // namespace dotpose::cli

// Commands that a web page sends to the program, as small JSON objects.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace dotpose::serve {

/// Maximum size of a command in bytes.
inline constexpr std::size_t kMaxCommandBytes = 1024;

/// A command: {"do": NAME, ...}. The other members are its arguments.
struct Command {
    using Value = std::variant<bool, double, std::string>;

    std::string name;
    std::map<std::string, Value, std::less<>> arguments;

    /// Returns an argument, or null if it is missing or has another type.
    template <typename T>
    const T* argument(std::string_view key) const {
        const auto found = arguments.find(key);
        return found == arguments.end() ? nullptr : std::get_if<T>(&found->second);
    }
};

/// Parses a command. Returns nullopt if the text is too long, if it is not a JSON object whose
/// members are booleans, numbers and strings, or if the command has no name.
std::optional<Command> parse_command(std::string_view text);

}  // namespace dotpose::serve

#include "serve/command.hpp"

#include <simdjson.h>

namespace dotpose::serve {
namespace {

std::optional<Command::Value> value_of(const simdjson::dom::element& element) {
    if (bool flag = false; element.get(flag) == simdjson::SUCCESS) return flag;
    if (double number = 0; element.get(number) == simdjson::SUCCESS) return number;
    if (std::string_view text; element.get(text) == simdjson::SUCCESS) return std::string(text);
    return std::nullopt;
}

}  // namespace

std::optional<Command> parse_command(std::string_view text) {
    if (text.size() > kMaxCommandBytes) return std::nullopt;
    simdjson::dom::parser parser;
    simdjson::dom::object object;
    if (parser.parse(simdjson::padded_string(text)).get(object) != simdjson::SUCCESS)
        return std::nullopt;
    Command command;
    for (const auto& [key, element] : object) {
        std::optional<Command::Value> value = value_of(element);
        if (!value) return std::nullopt;
        if (key == "do") {
            const std::string* name = std::get_if<std::string>(&*value);
            if (name == nullptr) return std::nullopt;
            command.name = *name;
        } else {
            command.arguments.insert_or_assign(std::string(key), std::move(*value));
        }
    }
    if (command.name.empty()) return std::nullopt;
    return command;
}

}  // namespace dotpose::serve

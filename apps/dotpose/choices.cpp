#include "choices.hpp"

#include <algorithm>

#include "nearest_name.hpp"

namespace dotpose::cli {
namespace {

/// Begins the name of a validator of `one_of`. The names that it accepts follow, one a line: of a
/// validator, an option gives back no more than its name and its place in the help.
constexpr const char* kOneOf = "one of";

}  // namespace

CLI::Validator one_of(const std::vector<std::string>& names,
                      const std::vector<std::string>& earlier_names) {
    const auto refusal = [names, earlier_names](const std::string& value) -> std::string {
        for (const auto& accepted : {names, earlier_names}) {
            if (std::find(accepted.begin(), accepted.end(), value) != accepted.end()) return {};
        }
        return "'" + value + "' is not " + alternatives(names) + did_you_mean(value, names);
    };
    std::string label = kOneOf;
    for (const std::string& name : names)
        label += "\n" + name;
    return CLI::Validator(refusal, "", label);
}

std::vector<std::string> choices_of(CLI::Option& option) {
    std::vector<std::string> names;
    try {
        for (int i = 0;; ++i) {
            const std::string label = option.get_validator(i)->get_name();
            std::vector<std::string> lines = CLI::detail::split(label, '\n');
            if (lines.front() == kOneOf) names.assign(lines.begin() + 1, lines.end());
        }
    } catch (const CLI::OptionNotFound&) {
        return names;  // there is no validator i
    }
}

std::string alternatives(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

}  // namespace dotpose::cli

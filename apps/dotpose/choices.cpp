#include "choices.hpp"

#include <algorithm>

#include "nearest_name.hpp"

namespace dotpose::cli {

Validator one_of(const std::vector<std::string>& names) {
    const auto refusal = [names](const std::string& value) -> std::string {
        if (std::ranges::find(names, value) != names.end()) return {};
        return "'" + value + "' is not " + alternatives(names) + did_you_mean(value, names);
    };
    return Validator(refusal, names);
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

#include "metrics_text.hpp"

#include "terminal_text.hpp"

namespace dotpose::cli {

std::string label(std::string_view name, std::string_view value) {
    std::string escaped;
    for (const char c : printable(value)) {
        if (c == '\\' || c == '"') escaped += '\\';
        escaped += c;
    }
    return fmt::format("{}=\"{}\"", name, escaped);
}

}  // namespace dotpose::cli

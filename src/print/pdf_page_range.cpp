#include "pdf_page_range.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <qpdf/QUtil.hh>

#include "dotpose/files/error.hpp"

namespace dotpose::print {

std::set<int> page_numbers(const std::string& range, int count) {
    if (range.empty()) {
        std::set<int> all;
        for (int number = 1; number <= count; ++number)
            all.insert(number);
        return all;
    }
    try {
        const std::vector<int> numbers = QUtil::parse_numrange(range.c_str(), count);
        return {numbers.begin(), numbers.end()};
    } catch (const std::runtime_error&) {
        throw BadArgument(
            fmt::format("pages '{}': give numbers from 1 to {} such as 1-3,7; z is the last page",
                        range, count));
    }
}

std::string page_list(const std::vector<int>& numbers) {
    constexpr std::size_t kShown = 8;
    const auto shown = std::span(numbers).first(std::min(kShown, numbers.size()));
    return fmt::format("page{} {}{}", numbers.size() > 1 ? "s" : "", fmt::join(shown, ", "),
                       numbers.size() > kShown ? " ..." : "");
}

}  // namespace dotpose::print

/// Natural sort order for names, in which numbers are compared by value: robot2 precedes robot10.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace dotpose::cli {

/// Compares names byte by byte, except that sequences of digits are compared as numbers of any
/// length. Names that differ only in leading zeros are compared as text, so only identical names
/// are equivalent.
struct NaturalOrder {
    using is_transparent = void;

    bool operator()(std::string_view a, std::string_view b) const {
        const std::string_view whole_a = a;
        const std::string_view whole_b = b;
        while (!a.empty() && !b.empty()) {
            const std::string_view number_a = take_number(a);
            const std::string_view number_b = take_number(b);
            if (number_a.size() != number_b.size() && !number_a.empty() && !number_b.empty()) {
                return number_a.size() < number_b.size();
            }
            const std::string_view piece_a = number_a.empty() ? take_byte(a) : number_a;
            const std::string_view piece_b = number_b.empty() ? take_byte(b) : number_b;
            if (piece_a != piece_b) return piece_a < piece_b;
        }
        if (a.empty() != b.empty()) return a.empty();
        return whole_a < whole_b;
    }

  private:
    /// Removes the digits at the start of `text`, and returns them without leading zeros. Returns
    /// "0" if all digits are zeros, and an empty string if there are no digits.
    static std::string_view take_number(std::string_view& text) {
        const std::size_t size = std::min(text.find_first_not_of("0123456789"), text.size());
        std::string_view number = text.substr(0, size);
        text.remove_prefix(size);
        while (number.size() > 1 && number.front() == '0')
            number.remove_prefix(1);
        return number;
    }
    static std::string_view take_byte(std::string_view& text) {
        const std::string_view byte = text.substr(0, 1);
        text.remove_prefix(byte.size());
        return byte;
    }
};

}  // namespace dotpose::cli

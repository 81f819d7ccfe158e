#include "number.hpp"

#include <array>

#include "host.hpp"

void print_number(std::int64_t number) {
    std::array<char, 22> text;
    char* digit = &text.back();
    *digit = '\0';
    auto rest = static_cast<std::uint64_t>(number < 0 ? -number : number);
    do {
        *--digit = static_cast<char>('0' + rest % 10);
        rest /= 10;
    } while (rest != 0);
    if (number < 0) *--digit = '-';
    *--digit = ' ';
    host::print(digit);
}

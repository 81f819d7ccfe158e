// Decoding: finds the position of a window of symbols in the code (paper, sections II-A and
// II-B.7). Misread symbols are not corrected.
#include <array>
#include <cstddef>

#include "code/basis.hpp"
#include "dotpose/code.hpp"

namespace dotpose {
namespace {

constexpr int kMaxWindow = 32;
constexpr int kMinWindow = code::kMainOrder;

using Rolls = std::array<std::uint8_t, kMaxWindow>;
using Deltas = std::array<std::uint8_t, kMaxWindow - 1>;

/// Occurrences of a string of digits in a secondary sequence: the place of the first occurrence,
/// and the number of occurrences. `first` is valid only if `count` is positive.
struct Places {
    std::uint32_t first = 0;
    int count = 0;
};

/// Returns true if a.digit(place + i) equals digit `digit` of deltas[i] for all i. Indices into
/// the sequence wrap around.
bool matches_at(const code::Secondary& a, std::size_t digit, std::span<const std::uint8_t> deltas,
                std::uint32_t place) {
    for (const std::uint8_t d : deltas) {
        if (a.digit(place) != code::digit_of_delta(d, digit)) return false;
        place = place + 1 == a.length ? 0 : place + 1;
    }
    return true;
}

Places find(const code::Secondary& a, std::size_t digit, std::span<const std::uint8_t> deltas) {
    unsigned key = 0;
    for (const std::uint8_t d : deltas.first(code::kOrder))
        key = key * a.base + code::digit_of_delta(d, digit);
    const std::uint8_t first = a.first_place_of[key];
    Places places;
    if (first == code::kAbsent) return places;
    if (!a.has_twins) {
        // The first kOrder digits occur only at `first`, so only the remaining digits have to be
        // compared.
        std::uint32_t next = first + std::uint32_t{code::kOrder};
        if (next >= a.length) next -= a.length;
        return {first, matches_at(a, digit, deltas.subspan(code::kOrder), next) ? 1 : 0};
    }
    for (std::uint32_t place = first; place < a.length; ++place) {
        if (!matches_at(a, digit, deltas, place)) continue;
        if (places.count++ == 0) places.first = place;
    }
    return places;
}

/// Returns the index in the main sequence at which the bits of a column or row begin, or kAbsent if
/// the main sequence does not contain these bits.
std::uint8_t place_in_main(const SymbolWindow& window, bool columns, int line) {
    const int length = columns ? window.rows : window.columns;
    const auto bit = [&](int i) -> unsigned {
        const int index = columns ? i * window.columns + line : line * window.columns + i;
        const Symbol symbol = window.symbols[static_cast<std::size_t>(index)];
        return static_cast<unsigned>(columns ? x_bit(symbol) : y_bit(symbol));
    };
    unsigned key = 0;
    for (int i = 0; i < code::kMainOrder; ++i)
        key = key * 2 + bit(i);
    const std::uint8_t place = code::kPlaceInMain[key];
    if (place == code::kAbsent) return place;
    for (int i = code::kMainOrder; i < length; ++i) {
        if (static_cast<int>(bit(i)) != main_bit(place + static_cast<unsigned>(i))) {
            return code::kAbsent;
        }
    }
    return place;
}

/// Decodes the columns of a window, or the rows if `columns` is false. Sets `first_roll` and
/// `position` to the roll and the position of the first column or row. Errors: not_in_code,
/// ambiguous.
Status read_axis(CodeVariant code, const SymbolWindow& window, bool columns,
                 std::uint8_t& first_roll, std::uint32_t& position) {
    Rolls rolls{};
    const auto count = static_cast<std::size_t>(columns ? window.columns : window.rows);
    for (std::size_t i = 0; i < count; ++i) {
        rolls[i] = place_in_main(window, columns, static_cast<int>(i));
        if (rolls[i] == code::kAbsent) return Status::not_in_code;
    }
    first_roll = rolls[0];
    return position_from_rolls(code, std::span(rolls).first(count), position);
}

}  // namespace

Status position_from_rolls(CodeVariant code, std::span<const std::uint8_t> rolls,
                           std::uint32_t& position) noexcept {
    if (rolls.size() < kMinWindow || rolls.size() > kMaxWindow) {
        return Status::bad_window;
    }
    Deltas storage;
    const auto deltas = std::span(storage).first(rolls.size() - 1);
    for (std::size_t i = 0; i < deltas.size(); ++i) {
        const int step = rolls[i + 1] - rolls[i];
        const int d = step < 0 ? step + kSections : step;
        if (d < code::kMinDelta || d > code::kMaxDelta) return Status::not_in_code;
        deltas[i] = static_cast<std::uint8_t>(d);
    }
    std::array<std::uint32_t, 4> first_places;
    int ways = 1;
    const code::Basis& basis = code::basis(code);
    for (std::size_t n = 0; n < first_places.size(); ++n) {
        const Places places = find(basis[n], n, deltas);
        if (places.count == 0) return Status::not_in_code;
        first_places[n] = places.first;
        ways *= places.count;
    }
    if (ways > 1) return Status::ambiguous;
    position = code::position_at(basis, first_places);
    return Status::ok;
}

Status decode(CodeVariant code, const SymbolWindow& window, Place& place) noexcept {
    const auto fits = [](int n) { return n >= kMinWindow && n <= kMaxWindow; };
    if (!fits(window.columns) || !fits(window.rows) ||
        window.symbols.size() < static_cast<std::size_t>(window.columns * window.rows)) {
        return Status::bad_window;
    }
    std::uint8_t roll_x = 0;
    std::uint8_t roll_y = 0;
    Place found;
    if (const Status s = read_axis(code, window, true, roll_x, found.cell.x); s != Status::ok) {
        return s;
    }
    if (const Status s = read_axis(code, window, false, roll_y, found.cell.y); s != Status::ok) {
        return s;
    }
    found.section.u =
        static_cast<std::uint8_t>(section_of(code, roll_x, found.cell.x, found.cell.y));
    found.section.v =
        static_cast<std::uint8_t>(section_of(code, roll_y, found.cell.y, found.cell.x));
    place = found;
    return Status::ok;
}

}  // namespace dotpose

#include "code/rolls.hpp"

#include "code/basis.hpp"

namespace dotpose::code {

int roll_from(Profile profile, std::uint32_t position, int section, std::uint32_t cross) {
    return (roll(profile, position) + section + static_cast<int>(cross % kSections)) % kSections;
}

void follow_rolls(Profile profile, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls) {
    const Basis& sequences = basis(profile);
    std::array<std::uint32_t, 4> places;
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = position % sequences[k].length;
    int roll = first_roll;
    for (std::uint8_t& out : rolls) {
        out = static_cast<std::uint8_t>(roll);
        roll += kSmallestDelta;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const Secondary& a = sequences[k];
            roll += a.weight * a.digits[places[k]];
            if (++places[k] == a.length) places[k] = 0;
        }
        if (roll >= kSections) roll -= kSections;
    }
}

}  // namespace dotpose::code

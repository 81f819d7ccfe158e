#include "core/integrity/line_sets.hpp"

#include <algorithm>

namespace dotpose::core {

EqualPlaces::EqualPlaces(const LossTables& lines) {
    const auto line_count = static_cast<std::size_t>(lines.count());
    for (std::size_t k = 0; k < all_.size(); ++k) {
        const code::Secondary& sequence = lines.ratios.basis[k];
        const std::size_t length = sequence.length;
        all_[k].fill(0);
        std::fill_n(all_[k].begin(), length / 32, ~std::uint32_t{0});
        all_[k][length / 32] = (std::uint32_t{1} << length % 32) - 1;
        std::uint32_t place = lines.ratios.places[k];
        own_[k].fill(0);
        own_[k][place / 32] = std::uint32_t{1} << place % 32;
        for (std::size_t step = 0; step + 1 < line_count; ++step) {
            const std::uint32_t* equal = sequence.places_of[sequence.digit(place)] + step / 32;
            const std::size_t ahead = step % 32;
            PlaceBits& places = equal_[step][k];
            for (std::size_t word = 0; word < places.size(); ++word)
                places[word] = equal[word] >> ahead | equal[word + 1] << 1 << (31 - ahead);
            if (++place == sequence.length) place = 0;
        }
    }
}

void EqualPlaces::keep_equal(std::size_t step, PlaceSets& places) const {
    for (std::size_t k = 0; k < places.size(); ++k) {
        for (std::size_t word = 0; word < places[k].size(); ++word)
            places[k][word] &= equal_[step][k][word];
    }
}

int EqualPlaces::count_different(const PlaceSets& places) const {
    int different = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        std::uint32_t others = 0;
        for (std::size_t word = 0; word < places[k].size(); ++word)
            others |= places[k][word] & ~own_[k][word];
        different += others != 0 ? 1 : 0;
    }
    return different;
}

}  // namespace dotpose::core

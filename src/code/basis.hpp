// Basis: the four secondary sequences that define a code.
#pragma once

#include <array>
#include <cstdint>

#include "code/tables.hpp"
#include "dotpose/code.hpp"

namespace dotpose::code {

constexpr const Basis& basis(CodeVariant code) {
    switch (code) {
        case CodeVariant::libdots:
            return kBasis<kA4Published>;
        case CodeVariant::microdots:
            return kBasis<kA4Microdots>;
        case CodeVariant::anoto:
            break;
    }
    return kBasis<kA4Restored>;
}

/// Returns the position with the given places in the four sequences. places[k] is the position
/// modulo the length of sequence k, which is 236, 233, 31 or 241.
std::uint32_t position_at(const Basis& basis, const std::array<std::uint32_t, 4>& places);

}  // namespace dotpose::code

// The four secondary number sequences of a profile.
#pragma once

#include "code/tables.hpp"
#include "dotpose/code.hpp"

namespace dotpose::code {

constexpr const Basis& basis(Profile profile) {
    switch (profile) {
        case Profile::published:
            return kBasis<kA4Published>;
        case Profile::microdots:
            return kBasis<kA4Microdots>;
        case Profile::anoto:
            break;
    }
    return kBasis<kA4Restored>;
}

constexpr const Twins& twins(Profile profile) {
    switch (profile) {
        case Profile::published:
            return kTwins<kA4Published>;
        case Profile::microdots:
            return kTwins<kA4Microdots>;
        case Profile::anoto:
            break;
    }
    return kTwins<kA4Restored>;
}

}  // namespace dotpose::code

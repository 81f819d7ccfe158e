/// Colours of PDF content: what they are, and what `OverlayOptions` makes of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// What the numbers of a colour mean, as far as they can be changed.
enum class ColourKind : std::uint8_t {
    grey,   ///< one number, 0 is black
    rgb,    ///< three, 0 is dark
    cmyk,   ///< four, 0 is light
    black,  ///< one, the amount of black ink (Separation /Black or /All)
    other,  ///< anything else: patterns, spot colours, Lab, Indexed
};

/// How many numbers a colour of this kind has; 0 for other.
std::size_t components(ColourKind kind);

/// Kind of a colour space: a device name, or an array such as [/ICCBased stream]. Named resources
/// are looked up in `spaces`, which may be null.
ColourKind kind_of_space(QPDFObjectHandle space, QPDFObjectHandle spaces);

/// Part of the black ink that a colour needs: as given, or as a printer makes it from grey and RGB.
double black_of(ColourKind kind, std::span<const double> colour);

/// The change that was asked for.
struct InkChange {
    bool black_to_cmy = false;
    double lighten = 0;

    bool is_none() const { return !black_to_cmy && lighten == 0; }

    /// Kind of a changed colour.
    ColourKind kind(ColourKind from) const;
    /// A changed colour, in numbers of `kind(from)`. `from` is not other.
    std::vector<double> apply(ColourKind from, std::span<const double> colour) const;
};

}  // namespace dotpose::print

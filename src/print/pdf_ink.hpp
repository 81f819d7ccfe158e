/// Colours of PDF content, and the conversions that `OverlayOptions` requests.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// Kinds of colour spaces, by the meaning of their components.
enum class ColourKind : std::uint8_t {
    grey,   ///< one component, where 0 is black
    rgb,    ///< three components, where 0 is dark
    cmyk,   ///< four components, where 0 is no ink
    black,  ///< one component: the amount of black ink (Separation /Black or /All)
    other,  ///< colours that cannot be converted: patterns, spot colours, Lab, Indexed
};

/// Returns the number of components of a colour, or 0 for `ColourKind::other`.
std::size_t components(ColourKind kind);

/// Returns the kind of a colour space. `space` is the name of a device space, an array such as
/// [/ICCBased stream], or a name that is defined in the resources `spaces`, which may be null.
ColourKind kind_of_space(QPDFObjectHandle space, QPDFObjectHandle spaces);

/// Returns the amount of black ink, from 0 to 1, used to print a colour. For grey and RGB, which
/// the printer converts, returns the amount of black that the usual conversion yields. Returns 0
/// for `ColourKind::other`.
double black_of(ColourKind kind, std::span<const double> colour);

/// Colour changes that `OverlayOptions` requests.
struct InkChange {
    bool black_to_cmy = false;
    double lighten = 0;

    bool is_none() const { return !black_to_cmy && lighten == 0; }

    /// Returns the kind of the converted colour if the original colour is of kind `from`.
    ColourKind kind(ColourKind from) const;
    /// Returns the components of the converted colour, whose kind is `kind(from)`. `from` must not
    /// be `ColourKind::other`.
    std::vector<double> apply(ColourKind from, std::span<const double> colour) const;
};

}  // namespace dotpose::print

/// Colours of PDF content and the changes to them that `OverlayOptions` can ask for.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// What the components of a colour mean.
enum class ColourKind : std::uint8_t {
    grey,   ///< one component, 0 is black
    rgb,    ///< three components, 0 is dark
    cmyk,   ///< four components, 0 is no ink
    black,  ///< one component, the amount of black ink (Separation /Black or /All)
    other,  ///< colours that cannot be changed: patterns, spot colours, Lab, Indexed
};

/// Number of components of a colour of this kind; 0 for `ColourKind::other`.
std::size_t components(ColourKind kind);

/// Returns the kind of a colour space, which is the name of a device space or an array such as
/// [/ICCBased stream]. Other names are looked up in the resources `spaces`, which may be null.
ColourKind kind_of_space(QPDFObjectHandle space, QPDFObjectHandle spaces);

/// Returns the share of black ink, 0 to 1, that a colour is printed with: the given one, or the one
/// that a printer computes from grey or RGB.
double black_of(ColourKind kind, std::span<const double> colour);

/// The changes of colours that `OverlayOptions` asks for.
struct InkChange {
    bool black_to_cmy = false;
    double lighten = 0;

    bool is_none() const { return !black_to_cmy && lighten == 0; }

    /// Returns the kind of the colour that replaces one of the kind `from`.
    ColourKind kind(ColourKind from) const;
    /// Returns the components, of the kind `kind(from)`, of the colour that replaces this one.
    /// `from` must not be `ColourKind::other`.
    std::vector<double> apply(ColourKind from, std::span<const double> colour) const;
};

}  // namespace dotpose::print

#include "pdf_ink.hpp"

#include <algorithm>

namespace dotpose::print {
namespace {

ColourKind kind_by_count(int count) {
    return count == 1   ? ColourKind::grey
           : count == 3 ? ColourKind::rgb
           : count == 4 ? ColourKind::cmyk
                        : ColourKind::other;
}

ColourKind kind_of_name(const std::string& name) {
    if (name == "/DeviceGray" || name == "/CalGray" || name == "/G") return ColourKind::grey;
    if (name == "/DeviceRGB" || name == "/CalRGB" || name == "/RGB") return ColourKind::rgb;
    if (name == "/DeviceCMYK" || name == "/CMYK") return ColourKind::cmyk;
    return ColourKind::other;
}

}  // namespace

std::size_t components(ColourKind kind) {
    switch (kind) {
        case ColourKind::grey:
        case ColourKind::black:
            return 1;
        case ColourKind::rgb:
            return 3;
        case ColourKind::cmyk:
            return 4;
        case ColourKind::other:
            break;
    }
    return 0;
}

ColourKind kind_of_space(QPDFObjectHandle space, QPDFObjectHandle spaces) {
    if (space.isName()) {
        if (spaces.isDictionary() && spaces.hasKey(space.getName())) {
            return kind_of_space(spaces.getKey(space.getName()), QPDFObjectHandle::newNull());
        }
        return kind_of_name(space.getName());
    }
    if (!space.isArray() || space.getArrayNItems() < 1 || !space.getArrayItem(0).isName()) {
        return ColourKind::other;
    }
    const std::string family = space.getArrayItem(0).getName();
    if (family == "/ICCBased" && space.getArrayNItems() > 1 && space.getArrayItem(1).isStream()) {
        QPDFObjectHandle count = space.getArrayItem(1).getDict().getKey("/N");
        return count.isInteger() ? kind_by_count(count.getIntValueAsInt()) : ColourKind::other;
    }
    if (family == "/Separation" && space.getArrayNItems() > 1) {
        QPDFObjectHandle ink = space.getArrayItem(1);
        const bool is_black = ink.isNameAndEquals("/Black") || ink.isNameAndEquals("/All");
        return is_black ? ColourKind::black : ColourKind::other;
    }
    return kind_of_name(family);
}

double black_of(ColourKind kind, std::span<const double> colour) {
    switch (kind) {
        case ColourKind::grey:
            return 1 - colour[0];
        case ColourKind::rgb:
            return 1 - std::max({colour[0], colour[1], colour[2]});
        case ColourKind::cmyk:
            return colour[3];
        case ColourKind::black:
            return colour[0];
        case ColourKind::other:
            break;
    }
    return 0;
}

ColourKind InkChange::kind(ColourKind from) const {
    return black_to_cmy || from == ColourKind::black ? ColourKind::cmyk : from;
}

std::vector<double> InkChange::apply(ColourKind from, std::span<const double> colour) const {
    const double keep = 1 - lighten;
    const auto lit = [keep](double light) { return 1 - (1 - light) * keep; };
    std::vector<double> changed(colour.begin(), colour.end());
    if (!black_to_cmy) {
        if (from == ColourKind::black) return {0, 0, 0, colour[0] * keep};
        for (double& value : changed)
            value = from == ColourKind::cmyk ? value * keep : lit(value);
        return changed;
    }
    // Uses the simplest conversion, in which equal parts of cyan, magenta and yellow replace black.
    double cmy[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
        cmy[i] = from == ColourKind::grey    ? 1 - colour[0]
                 : from == ColourKind::black ? colour[0]
                 : from == ColourKind::rgb   ? 1 - colour[i]
                                             : std::min(1.0, colour[i] + colour[3]);
    }
    return {cmy[0] * keep, cmy[1] * keep, cmy[2] * keep, 0};
}

}  // namespace dotpose::print

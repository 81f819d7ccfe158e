#include "pdf_colour_filter.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/core.h>

namespace dotpose::print {
namespace {

using Token = QPDFTokenizer::Token;

constexpr std::size_t kMaxPending = 1000;

bool is_blank(const Token& token) {
    return token.getType() == QPDFTokenizer::tt_space ||
           token.getType() == QPDFTokenizer::tt_comment;
}

std::vector<double> black(ColourKind kind) {
    switch (kind) {
        case ColourKind::cmyk:
            return {0, 0, 0, 1};
        case ColourKind::black:
            return {1};
        default:
            return std::vector<double>(components(kind), 0.0);
    }
}

}  // namespace

ColourFilter::ColourFilter(InkChange change, std::map<std::string, ColourKind> spaces,
                           bool starts_black)
    : change_(change), spaces_(std::move(spaces)), starts_black_(starts_black) {
    if (starts_black) now_ = {ColourKind::grey, ColourKind::grey};
}

void ColourFilter::handleToken(Token const& token) {
    if (std::exchange(starts_black_, false)) {
        write_colour(ColourKind::grey, {0}, false);
        write_colour(ColourKind::grey, {0}, true);
    }
    if (token.getType() != QPDFTokenizer::tt_word) {
        // The operators that this filter rewrites have fewer than kMaxPending operands. If
        // kMaxPending tokens are pending, they therefore belong to another operator and are written
        // unchanged.
        if (pending_.size() == kMaxPending) flush();
        pending_.push_back(token);
        return;
    }
    if (rewrite(token.getValue())) {
        pending_.clear();
        return;
    }
    flush();
    writeToken(token);
}

void ColourFilter::handleEOF() {
    flush();
}

void ColourFilter::flush() {
    for (const Token& token : pending_)
        writeToken(token);
    pending_.clear();
}

bool ColourFilter::rewrite(const std::string& name) {
    if (name == "q") saved_.push_back(now_);
    if (name == "Q" && !saved_.empty()) {
        now_ = saved_.back();
        saved_.pop_back();
    }
    std::vector<double> values;
    const auto device = [&](ColourKind kind, bool is_stroke) {
        (is_stroke ? now_.stroke : now_.fill) = kind;
        return numbers(values) && write_colour(kind, values, is_stroke);
    };
    if (name == "g" || name == "G") return device(ColourKind::grey, name == "G");
    if (name == "rg" || name == "RG") return device(ColourKind::rgb, name == "RG");
    if (name == "k" || name == "K") return device(ColourKind::cmyk, name == "K");
    if (name == "cs") return select_space(now_.fill, false);
    if (name == "CS") return select_space(now_.stroke, true);
    if (name == "sc" || name == "scn" || name == "SC" || name == "SCN") {
        const bool is_stroke = name.front() == 'S';
        const ColourKind kind = is_stroke ? now_.stroke : now_.fill;
        return numbers(values) && write_colour(kind, values, is_stroke);
    }
    return false;
}

bool ColourFilter::select_space(ColourKind& kind, bool is_stroke) {
    const auto name = std::ranges::find(pending_, QPDFTokenizer::tt_name, &Token::getType);
    kind = ColourKind::other;
    if (name == pending_.end()) return false;
    const auto known = spaces_.find(name->getValue());
    kind = known != spaces_.end() ? known->second
                                  : kind_of_space(QPDFObjectHandle::newName(name->getValue()),
                                                  QPDFObjectHandle::newNull());
    return kind != ColourKind::other && write_colour(kind, black(kind), is_stroke);
}

bool ColourFilter::write_colour(ColourKind from, std::vector<double> colour, bool is_stroke) {
    if (from == ColourKind::other || colour.size() != components(from)) return false;
    for (double& value : colour)
        value = std::clamp(value, 0.0, 1.0);
    std::string text = "\n";
    for (const double value : change_.apply(from, colour))
        text += fmt::format("{:.4g} ", value);
    const ColourKind kind = change_.kind(from);
    const char* name = kind == ColourKind::grey ? "g" : kind == ColourKind::rgb ? "rg" : "k";
    const char* stroke = kind == ColourKind::grey ? "G" : kind == ColourKind::rgb ? "RG" : "K";
    write(text + (is_stroke ? stroke : name) + "\n");
    return true;
}

bool ColourFilter::numbers(std::vector<double>& values) const {
    for (const Token& token : pending_) {
        if (is_blank(token)) continue;
        if (token.getType() != QPDFTokenizer::tt_integer &&
            token.getType() != QPDFTokenizer::tt_real) {
            return false;
        }
        values.push_back(std::strtod(token.getValue().c_str(), nullptr));
    }
    return true;
}

}  // namespace dotpose::print

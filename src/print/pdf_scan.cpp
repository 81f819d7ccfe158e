#include "pdf_scan.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pdf_ink.hpp"

namespace dotpose::print {
namespace {

// Under a tenth of black ink a dot still stands out.
constexpr double kHidingBlack = 0.1;

/// What content starts with: device grey 0, which is black.
struct Colour {
    ColourKind kind = ColourKind::grey;
    bool is_black = true;
};

struct Colours {
    Colour fill;
    Colour stroke;
};

class Scan : public QPDFObjectHandle::ParserCallbacks {
  public:
    Scan(QPDFObjectHandle resources, Colours start, std::set<QPDFObjGen>& seen, PageContent& found)
        : resources_(std::move(resources)), now_(start), seen_(seen), found_(found) {}

    void handleObject(QPDFObjectHandle object) override {
        if (object.isOperator()) {
            handle_operator(object.getOperatorValue());
            operands_.clear();
        } else {
            operands_.push_back(object);
        }
    }
    void handleEOF() override {}

    int unclosed_saves() const { return static_cast<int>(saved_.size()); }
    int extra_restores() const { return extra_restores_; }

  private:
    void handle_operator(const std::string& name) {
        const auto is = [&name](std::initializer_list<const char*> names) {
            return std::ranges::find(names, name) != names.end();
        };
        if (name == "q") {
            saved_.push_back(now_);
        } else if (name == "Q") {
            restore();
        } else if (is({"g", "rg", "k"})) {
            set(now_.fill, kind_of_count());
        } else if (is({"G", "RG", "K"})) {
            set(now_.stroke, kind_of_count());
        } else if (is({"cs", "CS"}) && !operands_.empty()) {
            QPDFObjectHandle spaces = resources_.isDictionary() ? resources_.getKey("/ColorSpace")
                                                                : QPDFObjectHandle::newNull();
            (name == "cs" ? now_.fill : now_.stroke) = {kind_of_space(operands_.back(), spaces),
                                                        true};
        } else if (is({"sc", "scn"})) {
            set(now_.fill, now_.fill.kind);
        } else if (is({"SC", "SCN"})) {
            set(now_.stroke, now_.stroke.kind);
        } else if (is({"f", "F", "f*"})) {
            paint(now_.fill, true);
        } else if (is({"B", "B*", "b", "b*"})) {
            paint(now_.fill, true);
            paint(now_.stroke, false);
        } else if (is({"S", "s"})) {
            paint(now_.stroke, false);
        } else if (is({"Tj", "TJ", "'", "\""})) {
            paint(now_.fill, false);
        } else if (name == "sh") {
            found_.paints_areas = true;
        } else if (name == "EI") {
            found_.paints_areas = found_.paints_images = true;
        } else if (name == "Do" && !operands_.empty() && operands_.back().isName()) {
            paint_object(operands_.back().getName());
        }
    }

    void restore() {
        if (saved_.empty()) {
            ++extra_restores_;
            return;
        }
        now_ = saved_.back();
        saved_.pop_back();
    }

    ColourKind kind_of_count() const {
        return operands_.size() == 1   ? ColourKind::grey
               : operands_.size() == 3 ? ColourKind::rgb
                                       : ColourKind::cmyk;
    }

    void set(Colour& colour, ColourKind kind) {
        std::vector<double> values;
        for (QPDFObjectHandle& operand : operands_) {
            if (operand.isNumber()) values.push_back(operand.getNumericValue());
        }
        const bool is_known = components(kind) > 0 && values.size() == components(kind);
        colour = {kind, is_known && black_of(kind, values) > kHidingBlack};
    }

    void paint(const Colour& colour, bool is_area) {
        found_.paints_black |= colour.is_black;
        found_.paints_areas |= is_area;
    }

    void paint_object(const std::string& name) {
        QPDFObjectHandle objects =
            resources_.isDictionary() ? resources_.getKey("/XObject") : QPDFObjectHandle::newNull();
        if (!objects.isDictionary() || !objects.getKey(name).isStream()) return;
        QPDFObjectHandle object = objects.getKey(name);
        if (object.getDict().getKey("/Subtype").isNameAndEquals("/Image")) {
            found_.paints_areas = found_.paints_images = true;
            return;
        }
        if (!seen_.insert(object.getObjGen()).second) return;
        Scan scan(object.getDict().getKey("/Resources"), now_, seen_, found_);
        QPDFPageObjectHelper(object).parseContents(&scan);
    }

    QPDFObjectHandle resources_;
    Colours now_;
    std::set<QPDFObjGen>& seen_;
    PageContent& found_;
    std::vector<Colours> saved_;
    std::vector<QPDFObjectHandle> operands_;
    int extra_restores_ = 0;
};

}  // namespace

PageContent scan_page(QPDFPageObjectHelper page) {
    PageContent found;
    std::set<QPDFObjGen> seen;
    Scan scan(page.getAttribute("/Resources", false), {}, seen, found);
    page.parseContents(&scan);
    found.unclosed_saves = scan.unclosed_saves();
    found.extra_restores = scan.extra_restores();
    return found;
}

}  // namespace dotpose::print

#include "pdf_scan.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <qpdf/Pl_Concatenate.hh>
#include <qpdf/Pl_QPDFTokenizer.hh>

#include "dotpose/files/error.hpp"
#include "pdf_dots.hpp"
#include "pdf_ink.hpp"

namespace dotpose::print {
namespace {

// Limit for the amount of black ink, from 0 to 1. Content with more black ink hides black dots.
constexpr double kHidingBlack = 0.1;

/// The current colour. The initial colour is black (0 in DeviceGray).
struct Colour {
    ColourKind kind = ColourKind::grey;
    bool is_black = true;
};

struct Colours {
    Colour fill;
    Colour stroke;
};

/// State shared by the scan of a page and the scans of its forms.
struct PageScan {
    UnpackedBytes& unpacked;
    std::set<QPDFObjGen> seen;
    PageContent found;
};

/// Maximum number of stored operands. No operator has more than 33 operands: a name, and the 32
/// components of a colour.
constexpr std::size_t kMaxOperands = 64;

struct Operand {
    QPDFTokenizer::token_type_e type;
    std::string text;  ///< characters of a name or number
};

/// Scans content token by token. Parsed objects would need many times the memory of the raw bytes.
class Scan : public QPDFObjectHandle::TokenFilter {
  public:
    Scan(QPDFObjectHandle resources, Colours start, PageScan& page, int level)
        : resources_(std::move(resources)), now_(start), page_(page), level_(level) {
        require_pdf_level("forms", level);
    }

    void read(const std::vector<QPDFObjectHandle>& streams);

    void handleToken(QPDFTokenizer::Token const& token) override {
        switch (token.getType()) {
            case QPDFTokenizer::tt_space:
            case QPDFTokenizer::tt_comment:
            case QPDFTokenizer::tt_eof:
                return;
            case QPDFTokenizer::tt_bad:
                throw_damaged(last_operator_ == "ID" ? "an inline image has no end"
                                                     : token.getErrorMessage());
            case QPDFTokenizer::tt_array_open:
            case QPDFTokenizer::tt_dict_open:
                open_brackets_ += token.getValue().front();
                require_pdf_level("arrays", static_cast<int>(open_brackets_.size()));
                return;
            case QPDFTokenizer::tt_array_close:
            case QPDFTokenizer::tt_dict_close:
                close_bracket(token);
                return;
            case QPDFTokenizer::tt_word:
                handle_operator(token.getValue());
                return;
            default:
                add_operand(token);
        }
    }
    void handleEOF() override {
        if (!open_brackets_.empty()) throw_damaged("an array or dictionary has no end");
    }

    int unclosed_saves() const { return static_cast<int>(saved_.size()); }
    int extra_restores() const { return extra_restores_; }

  private:
    [[noreturn]] static void throw_damaged(const std::string& reason) {
        throw Error("damaged PDF: its content cannot be read: " + reason);
    }

    void close_bracket(const QPDFTokenizer::Token& token) {
        const char opened = token.getType() == QPDFTokenizer::tt_array_close ? '[' : '<';
        if (open_brackets_.empty() || open_brackets_.back() != opened) {
            throw_damaged("unexpected " + token.getValue());
        }
        open_brackets_.pop_back();
        add_operand(token);
    }

    void add_operand(const QPDFTokenizer::Token& token) {
        const auto type = token.getType();
        if (type == QPDFTokenizer::tt_brace_open || type == QPDFTokenizer::tt_brace_close) {
            throw_damaged("unexpected " + token.getValue());
        }
        if (!open_brackets_.empty()) return;
        if (operands_.size() == kMaxOperands) operands_.pop_front();
        const bool has_text = type == QPDFTokenizer::tt_name || is_number(type);
        operands_.push_back({type, has_text ? token.getValue() : std::string()});
    }

    static bool is_number(QPDFTokenizer::token_type_e type) {
        return type == QPDFTokenizer::tt_integer || type == QPDFTokenizer::tt_real;
    }

    void handle_operator(const std::string& name) {
        if (!open_brackets_.empty()) throw_damaged("unexpected " + name.substr(0, 20));
        last_operator_ = name;
        obey(name);
        operands_.clear();
    }

    void obey(const std::string& name) {
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
        } else if (is({"cs", "CS"}) && ends_with_name()) {
            const auto space = QPDFObjectHandle::newName(operands_.back().text);
            (name == "cs" ? now_.fill : now_.stroke) =
                Colour{kind_of_space(space, resource("/ColorSpace")), true};
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
            page_.found.paints_areas = true;
        } else if (name == "EI") {
            page_.found.paints_areas = page_.found.paints_images = true;
        } else if (name == "Do" && ends_with_name()) {
            paint_object(operands_.back().text);
        }
    }

    bool ends_with_name() const {
        return !operands_.empty() && operands_.back().type == QPDFTokenizer::tt_name;
    }

    QPDFObjectHandle resource(const char* kind) {
        return resources_.isDictionary() ? resources_.getKey(kind) : QPDFObjectHandle::newNull();
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
        for (const Operand& operand : operands_) {
            if (is_number(operand.type))
                values.push_back(std::strtod(operand.text.c_str(), nullptr));
        }
        const bool is_known = components(kind) > 0 && values.size() == components(kind);
        colour = {kind, is_known && black_of(kind, values) > kHidingBlack};
    }

    void paint(const Colour& colour, bool is_area) {
        page_.found.paints_black |= colour.is_black;
        page_.found.paints_areas |= is_area;
    }

    void paint_object(const std::string& name) {
        QPDFObjectHandle objects = resource("/XObject");
        if (!objects.isDictionary() || !objects.getKey(name).isStream()) return;
        QPDFObjectHandle object = objects.getKey(name);
        if (object.getDict().getKey("/Subtype").isNameAndEquals("/Image")) {
            page_.found.paints_areas = page_.found.paints_images = true;
            return;
        }
        if (!page_.seen.insert(object.getObjGen()).second) return;
        Scan(object.getDict().getKey("/Resources"), now_, page_, level_ + 1).read({object});
    }

    QPDFObjectHandle resources_;
    Colours now_;
    PageScan& page_;
    int level_;
    std::vector<Colours> saved_;
    std::deque<Operand> operands_;
    std::string open_brackets_;
    std::string last_operator_;
    int extra_restores_ = 0;
};

void Scan::read(const std::vector<QPDFObjectHandle>& streams) {
    Pl_QPDFTokenizer tokens("content", this);
    // The tokens are processed in manualFinish, after all streams have been unpacked, because qpdf
    // would turn an exception during unpacking into a warning.
    Pl_Concatenate all("content", &tokens);
    for (QPDFObjectHandle stream : streams) {
        page_.unpacked.count(stream);
        bool attempted = false;
        if (!stream.pipeStreamData(&all, &attempted, 0, qpdf_dl_specialized, true)) {
            throw_damaged("it cannot be unpacked");
        }
        all.writeCStr("\n");
    }
    all.manualFinish();
}

}  // namespace

std::string PageContent::before() const {
    std::string operators = "q\n";
    for (int i = 0; i < extra_restores; ++i)
        operators += "q\n";
    return operators;
}

std::string PageContent::after() const {
    std::string operators = "\nQ\n";
    for (int i = 0; i < unclosed_saves; ++i)
        operators += "Q\n";
    return operators;
}

PageContent scan_page(QPDFPageObjectHelper page, UnpackedBytes& unpacked) {
    unpacked.start_page();
    PageScan all{unpacked, {}, {}};
    Scan scan(page.getAttribute("/Resources", false), {}, all, 1);
    scan.read(page.getPageContents());
    all.found.unclosed_saves = scan.unclosed_saves();
    all.found.extra_restores = scan.extra_restores();
    return all.found;
}

bool has_dots(QPDF& pdf, QPDFPageObjectHelper page) {
    QPDFObjectHandle creator = pdf.getTrailer().getKeyIfDict("/Info").getKeyIfDict("/Creator");
    if (creator.isString() && creator.getUTF8Value() == kCreator) return true;
    QPDFObjectHandle objects = page.getAttribute("/Resources", false).getKeyIfDict("/XObject");
    if (!objects.isDictionary()) return false;
    return std::ranges::any_of(objects.getKeys(),
                               [](const std::string& name) { return name.starts_with(kDotsName); });
}

}  // namespace dotpose::print

#include "dotpose/tools/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <string>

#include <fmt/format.h>
#include <qpdf/QPDFAcroFormDocumentHelper.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFSystemError.hh>

#include "pdf_cards.hpp"
#include "pdf_colours.hpp"
#include "pdf_cross_references.hpp"
#include "pdf_file.hpp"
#include "pdf_limits.hpp"
#include "pdf_page_frame.hpp"
#include "pdf_page_range.hpp"
#include "pdf_scan.hpp"
#include "regions.hpp"

namespace dotpose {
namespace fs = std::filesystem;
namespace {

/// Returns true if "%PDF-" is in the first 1024 bytes, where PDF readers search for it.
bool begins_like_pdf(const fs::path& path) {
    std::string head(1024, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.find("%PDF-") != std::string::npos;
}

[[noreturn]] void throw_damaged(const fs::path& path, const std::string& reason) {
    if (!begins_like_pdf(path)) {
        throw Error(fmt::format("{} is not a PDF: save or print the document as a PDF first",
                                path.string()));
    }
    throw Error(fmt::format("{}: damaged PDF: {}; 'qpdf {} repaired.pdf' may repair it",
                            path.string(), reason, path.string()));
}

[[noreturn]] void throw_too_deep(const fs::path& path) {
    throw Error(fmt::format("{}: its objects are nested too deeply", path.string()));
}

/// Returns qpdf's warnings about faults that qpdf repairs in the new file. Throws Error for faults
/// in the content or in stream data, because qpdf would copy such faults unchanged.
std::set<std::string> repaired_faults(QPDF& pdf, const fs::path& path) {
    std::set<std::string> faults;
    for (const QPDFExc& warning : pdf.getWarnings()) {
        const std::string& detail = warning.getMessageDetail();
        if (print::is_too_deep(detail)) throw_too_deep(path);
        const bool is_in_content = warning.getObject() == "content";
        if (is_in_content || detail.find("stream data") != std::string::npos) {
            throw_damaged(path, detail);
        }
        faults.insert(detail);
    }
    return faults;
}

/// Runs `work`. If it throws an Error, prepends `name` to the message.
template <typename Work>
void with_name(const std::string& name, const Work& work) {
    try {
        work();
    } catch (const BadArgument& error) {
        throw BadArgument(fmt::format("{}: {}", name, error.what()));
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", name, error.what()));
    }
}

void open(QPDF& pdf, const fs::path& path, const std::string& password,
          print::UnpackedBytes& unpacked) {
    pdf.setSuppressWarnings(true);
    pdf.setAttemptRecovery(false);
    try {
        const auto file = print::open_pdf(path);
        with_name(path.string(), [&] { print::count_cross_references(path, unpacked); });
        pdf.processInputSource(file, password.c_str());
    } catch (const QPDFSystemError& error) {
        throw Error(fmt::format("cannot read {}: {}", path.string(),
                                std::generic_category().message(error.getErrno())));
    } catch (const QPDFExc& error) {
        if (error.getErrorCode() != qpdf_e_password) {
            throw_damaged(path, error.getMessageDetail());
        }
        throw Error(fmt::format(
            "{}: {}", path.string(),
            password.empty() ? "the file is encrypted; a password is needed" : "wrong password"));
    }
}

/// Returns the result of `work`. Converts exceptions thrown by qpdf to an Error that reports a
/// damaged document.
template <typename Work>
auto with_damage_errors(const fs::path& path, const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const QPDFExc& error) {
        throw_damaged(path, error.getMessageDetail());
    } catch (const std::exception& error) {
        throw_damaged(path, error.what());
    }
}

/// Throws Error if the page would need more than kMaxDots dots. This check is necessary because a
/// PDF page may have any size. For example, /UserUnit can make a side kilometres long.
void require_few_dots(const Sheet& sheet) {
    constexpr double kMaxDots = 5e7;
    const double dots = double{1} * sheet.columns * sheet.rows;
    if (dots <= kMaxDots) return;
    throw Error(
        fmt::format("a page of {:.0f} x {:.0f} mm needs {:.0f} million dots; at most {:.0f} "
                    "million are possible",
                    sheet.width_mm, sheet.height_mm, dots / 1e6, kMaxDots / 1e6));
}

class Overlay {
  public:
    Overlay(const fs::path& in, const OverlayOptions& options)
        : in_(in),
          options_(options),
          change_{options.black_to_cmy, options.lighten},
          rows_(std::make_shared<print::RowCount>()),
          dots_(pdf_, options.dpi, options.drawing, rows_),
          regions_(options.origin),
          unpacked_(options.max_content_mb),
          colours_(change_, unpacked_) {
        rows_->progress = options.progress;
        open(pdf_, in, options.password, unpacked_);
        with_name(in_.string(), [&] {
            unpacked_.count_object_streams(pdf_);
            print::require_shallow_page_tree(pdf_);
        });
    }

    void add_dots() {
        pages_ = all_pages();
        if (pages_.empty()) throw Error(fmt::format("{}: the document has no pages", in_.string()));
        const auto count = static_cast<int>(pages_.size());
        const std::set<int> numbers = print::page_numbers(options_.pages, count);
        if (numbers.size() * static_cast<std::size_t>(options_.copies) > kMaxPages) {
            throw BadArgument(fmt::format("{} copies of {} pages: at most {} pages get dots",
                                          options_.copies, numbers.size(), kMaxPages));
        }
        for (int copy = 0; copy < options_.copies; ++copy) {
            for (const int number : numbers)
                on_page(number, [&] { lay_out(copy * count + number, number); });
        }
        if (options_.place) options_.place(report_.pages);
        for (const int number : numbers)
            on_page(number, [&] { prepare(number); });
        if (options_.card_paper) {
            make_cards();
        } else {
            add_copies();
            for (const OverlaidPage& laid_out : report_.pages)
                on_page(laid_out.document_page, [&] { draw(laid_out); });
        }
        warn();
    }

    void write(const fs::path& out) {
        base::OutputFile file(out);
        print::write_document(pdf_, *rows_, file);
        for (const std::string& fault : repaired_faults(pdf_, in_))
            report_.warnings.push_back("the document had a fault that was repaired: " + fault);
        file.commit();
    }

    OverlayReport report() && { return std::move(report_); }

  private:
    std::vector<QPDFPageObjectHelper> all_pages() {
        std::vector<QPDFPageObjectHelper> pages = QPDFPageDocumentHelper(pdf_).getAllPages();
        repaired_faults(pdf_, in_);
        return pages;
    }

    /// Runs `work`. If it throws an Error, prepends the page number to the message.
    template <typename Work>
    void on_page(int number, const Work& work) {
        with_name(fmt::format("{}, page {}", in_.string(), number), work);
    }

    QPDFPageObjectHelper page(int number) const {
        return pages_[static_cast<std::size_t>(number - 1)];
    }

    void lay_out(int number, int document_page) {
        Sheet sheet = make_sheet({.pattern = options_.pattern,
                                  .origin = options_.origin,
                                  .paper = print::page_frame(page(document_page)).paper,
                                  .margin_mm = options_.margin_mm});
        validate_resolution(sheet, options_.dpi);
        require_few_dots(sheet);
        sheet.origin = regions_.take(sheet.columns, sheet.rows);
        report_.pages.push_back({number, sheet, document_page});
    }

    void prepare(int number) {
        QPDFPageObjectHelper original = page(number);
        if (print::has_dots(pdf_, original)) dotted_.push_back(number);
        const print::PageContent content = print::scan_page(original, unpacked_);
        if (content.paints_black) black_.push_back(number);
        if (content.paints_images) images_.push_back(number);
        if (content.paints_areas) areas_.push_back(number);
        if (!change_.is_none()) colours_.convert(original);
        print::write_turn_as_integer(original);
        contents_[number] = content;
    }

    void add_copies() {
        const std::vector<QPDFPageObjectHelper> originals = pages_;
        QPDFPageDocumentHelper document(pdf_);
        QPDFAcroFormDocumentHelper fields(pdf_);
        for (int copy = 1; copy < options_.copies; ++copy) {
            for (QPDFPageObjectHelper original : originals) {
                QPDFPageObjectHelper& added = pages_.emplace_back(original.shallowCopyPage());
                document.addPage(added, false);
                fields.fixCopiedAnnotations(added.getObjectHandle(), original.getObjectHandle(),
                                            fields);
            }
        }
    }

    /// Draws the dots over or under the content of the page. Adds streams with the operators q and
    /// Q around the content, so the page's own streams do not change and the dots are drawn in the
    /// initial graphics state.
    void draw(const OverlaidPage& laid_out) {
        const auto& [number, sheet, document_page] = laid_out;
        validate(sheet);
        QPDFPageObjectHelper drawn = page(number);
        std::string dots = "q " + print::page_frame(drawn).matrix + " cm\n" +
                           draw_forms(own_objects(drawn), sheet) + "Q\n";
        const print::PageContent& content = contents_.at(document_page);
        add_around(drawn, (options_.under ? dots : "") + content.before(),
                   content.after() + (options_.under ? "" : dots));
    }

    void add_around(QPDFPageObjectHelper drawn, const std::string& before,
                    const std::string& after) {
        drawn.addPageContents(QPDFObjectHandle::newStream(&pdf_, before), true);
        drawn.addPageContents(QPDFObjectHandle::newStream(&pdf_, after), false);
    }

    /// Gives a page its own copies of its resource and XObject dictionaries, because other pages
    /// may share the originals. Returns the copy of the XObject dictionary.
    static QPDFObjectHandle own_objects(QPDFPageObjectHelper drawn) {
        const auto copy = [](QPDFObjectHandle shared) {
            return shared.isDictionary() ? shared.shallowCopy() : QPDFObjectHandle::newDictionary();
        };
        QPDFObjectHandle resources = copy(drawn.getAttribute("/Resources", false));
        drawn.getObjectHandle().replaceKey("/Resources", resources);
        QPDFObjectHandle objects = copy(resources.getKey("/XObject"));
        resources.replaceKey("/XObject", objects);
        return objects;
    }

    /// Adds the dots of a sheet to an XObject dictionary. Returns the operators that draw them.
    std::string draw_forms(QPDFObjectHandle objects, const Sheet& sheet) {
        std::string content;
        int suffix = 1;
        for (const QPDFObjectHandle& form : dots_.forms(sheet)) {
            std::string name;
            do {
                name = print::kDotsName + std::to_string(suffix++);
            } while (objects.hasKey(name));
            objects.replaceKey(name, form);
            content += name + " Do\n";
        }
        return content;
    }

    void make_cards() {
        const Paper card = card_size();
        const print::CardGrid grid = print::card_grid(*options_.card_paper, card);
        std::map<int, QPDFObjectHandle> forms;
        for (const auto& [number, content] : contents_) {
            QPDFPageObjectHelper original = page(number);
            add_around(original, content.before(), content.after());
            forms[number] = print::card_form(original);
        }
        print::remove_pages(pdf_);
        const std::span<const OverlaidPage> all = report_.pages;
        const auto per_page = static_cast<std::size_t>(grid.cards());
        for (std::size_t first = 0; first < all.size(); first += per_page) {
            add_card_page(grid, all.subspan(first, std::min(per_page, all.size() - first)), forms);
        }
    }

    /// Returns the common size of all cards. Throws BadArgument if the sizes differ by more than
    /// kTolerance_mm.
    Paper card_size() const {
        constexpr double kTolerance_mm = 0.1;
        const Sheet& first = report_.pages.front().sheet;
        for (const auto& [number, sheet, document_page] : report_.pages) {
            if (std::abs(sheet.width_mm - first.width_mm) > kTolerance_mm ||
                std::abs(sheet.height_mm - first.height_mm) > kTolerance_mm) {
                throw BadArgument(fmt::format(
                    "{}: pages {} and {} differ in size; cards on one paper have the same size",
                    in_.string(), report_.pages.front().document_page, document_page));
            }
        }
        return {first.width_mm, first.height_mm};
    }

    void add_card_page(const print::CardGrid& grid, std::span<const OverlaidPage> cards,
                       const std::map<int, QPDFObjectHandle>& forms) {
        QPDFPageObjectHelper added = print::add_card_page(pdf_, grid);
        QPDFObjectHandle objects = own_objects(added);
        std::string content = print::cut_marks(grid);
        for (int slot = 0; slot < static_cast<int>(cards.size()); ++slot) {
            const auto& [number, sheet, document_page] = cards[static_cast<std::size_t>(slot)];
            validate(sheet);
            const std::string name = fmt::format("/Card{}", document_page);
            objects.replaceKey(name, forms.at(document_page));
            const std::string card =
                print::place_card(added, grid, slot, forms.at(document_page), name);
            const std::string dots = draw_forms(objects, print::on_page(grid, slot, sheet));
            content += options_.under ? dots + card : card + dots;
        }
        add_around(added, content, "");
        ++report_.card_pages;
    }

    void warn() {
        const auto add = [this](const std::vector<int>& numbers, const char* text) {
            if (!numbers.empty())
                report_.warnings.push_back(print::page_list(numbers) + ": " + text);
        };
        if (!change_.black_to_cmy) {
            add(black_,
                "black text or drawings hide dots: print black without black ink (--cmy-black), or "
                "lighten the document (--lighten 0.3)");
            add(images_, "images may hide dots where they are dark");
        }
        add(dotted_,
            "it already has dots of dotpose, and dots over dots cannot be read: use the document "
            "without dots");
        if (options_.under) add(areas_, "filled areas and images cover the dots below them");
        for (const std::string& kind : colours_.unconverted()) {
            report_.warnings.push_back(kind + " were not converted and may hide dots");
        }
        QPDFObjectHandle form = pdf_.getRoot().getKey("/AcroForm");
        if (form.isDictionary() && form.getKey("/SigFlags").isInteger() &&
            form.getKey("/SigFlags").getIntValue() % 2 == 1) {
            report_.warnings.emplace_back(
                "the document is signed: dots make the signature invalid");
        }
    }

    fs::path in_;
    const OverlayOptions& options_;
    print::InkChange change_;
    QPDF pdf_;
    std::shared_ptr<print::RowCount> rows_;
    print::DotContent dots_;
    print::Regions regions_;
    print::UnpackedBytes unpacked_;
    print::ColourConverter colours_;
    OverlayReport report_;
    /// Pages of the document, followed by the pages of each additional copy
    /// (OverlayOptions::copies).
    std::vector<QPDFPageObjectHelper> pages_;
    /// Results of `scan_page` by page number. Contains only the document pages that receive dots.
    std::map<int, print::PageContent> contents_;
    std::vector<int> dotted_;
    std::vector<int> black_;
    std::vector<int> images_;
    std::vector<int> areas_;
};

}  // namespace

OverlayReport overlay_pdf(const fs::path& in, const fs::path& out, const OverlayOptions& options) {
    if (!(options.lighten >= 0 && options.lighten < 1)) {
        throw BadArgument(
            fmt::format("lighten by {:g}: it must be at least 0 and under 1", options.lighten));
    }
    if (options.copies < 1) {
        throw BadArgument(fmt::format("{} copies: it must be 1 or more", options.copies));
    }
    std::error_code error;
    if (fs::equivalent(in, out, error)) {
        throw BadArgument(
            fmt::format("{} is the document itself; give the result another name", out.string()));
    }
    return with_damage_errors(in, [&] {
        Overlay overlay(in, options);
        overlay.add_dots();
        overlay.write(out);
        return std::move(overlay).report();
    });
}

}  // namespace dotpose

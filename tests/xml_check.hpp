/// A minimal check that a drawing is well-formed XML. It supports only the subset that the drawings
/// use: one root, matching tags, quoted attributes without repetition, and the five named entities.
/// UTF-8 is not checked.
#pragma once

#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotpose::test {

class XmlCheck {
  public:
    explicit XmlCheck(std::string_view text) : rest_(text) { check(); }

    /// Returns the first problem found, or an empty string if the text is well-formed.
    const std::string& problem() const { return problem_; }

  private:
    void check() {
        if (rest_.starts_with("<?xml ")) skip_past("?>");
        bool has_root = false;
        while (!rest_.empty() && problem_.empty()) {
            if (rest_.front() != '<') {
                check_text(rest_.substr(0, rest_.find('<')));
            } else if (rest_.starts_with("</")) {
                close_tag();
            } else {
                if (open_.empty() && has_root) fail("second root");
                has_root = true;
                open_tag();
            }
        }
        if (!open_.empty()) fail("not closed: " + open_.back());
        if (!has_root) fail("no root");
    }

    void fail(const std::string& problem) {
        if (problem_.empty()) problem_ = problem + " before: " + std::string(rest_.substr(0, 60));
    }
    void skip_past(std::string_view end) {
        const std::size_t at = rest_.find(end);
        if (at == std::string_view::npos) return fail("no " + std::string(end));
        rest_.remove_prefix(at + end.size());
    }
    void skip_space() {
        while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
            rest_.remove_prefix(1);
        }
    }
    std::string take_name() {
        std::size_t n = 0;
        while (n < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[n])) != 0 ||
                                    rest_[n] == '-' || rest_[n] == ':')) {
            ++n;
        }
        if (n == 0) fail("no name");
        const std::string name(rest_.substr(0, n));
        rest_.remove_prefix(n);
        return name;
    }
    void check_entities(std::string_view text) {
        for (std::size_t at = text.find('&'); at != std::string_view::npos;
             at = text.find('&', at + 1)) {
            const std::string_view from = text.substr(at);
            if (!from.starts_with("&amp;") && !from.starts_with("&lt;") &&
                !from.starts_with("&gt;") && !from.starts_with("&quot;")) {
                fail("bare &");
            }
        }
    }
    void check_text(std::string_view text) {
        check_entities(text);
        for (const char c : text) {
            if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') fail("control");
            if (open_.empty() && std::isspace(static_cast<unsigned char>(c)) == 0) {
                fail("text outside the root");
            }
        }
        rest_.remove_prefix(text.size());
    }
    void close_tag() {
        rest_.remove_prefix(2);
        const std::string name = take_name();
        if (open_.empty() || open_.back() != name) return fail("wrong end of " + name);
        open_.pop_back();
        skip_past(">");
    }
    void open_tag() {
        rest_.remove_prefix(1);
        const std::string name = take_name();
        std::set<std::string> attributes;
        while (problem_.empty()) {
            skip_space();
            if (rest_.starts_with("/>")) return rest_.remove_prefix(2);
            if (rest_.starts_with(">")) {
                open_.push_back(name);
                return rest_.remove_prefix(1);
            }
            const std::string attribute = take_name();
            if (!attributes.insert(attribute).second) fail("twice: " + attribute);
            if (!rest_.starts_with("=\"")) return fail("no value of " + attribute);
            rest_.remove_prefix(2);
            const std::string_view value = rest_.substr(0, rest_.find('"'));
            check_entities(value);
            if (value.find('<') != std::string_view::npos) fail("< in a value");
            skip_past("\"");
        }
    }

    std::string_view rest_;
    std::vector<std::string> open_;
    std::string problem_;
};

}  // namespace dotpose::test

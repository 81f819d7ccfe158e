#include "old_spellings.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace dotpose::cli {
namespace {

/// An option that was renamed.
struct Renamed {
    std::string_view command;
    std::string_view earlier;
    std::string_view now;
};
constexpr std::array kRenamed = {
    Renamed{"fleet", "--map", "--draw"},
    Renamed{"simulate", "--paper", "--paper-level"},
    Renamed{"watch", "--map", "--draw"},
};

/// A flag that became a value of an option.
struct FormerFlag {
    std::string_view command;
    std::string_view flag;
    std::string_view option;
    std::string_view value;
};
constexpr std::array kFormerFlags = {
    FormerFlag{"evaluate", "--json", "--format", "json"},
    FormerFlag{"optics", "--paper", "--device", "paper"},
    FormerFlag{"replay", "--json", "--format", "json"},
};

/// Commands whose lines of JSON had the format jsonl.
constexpr std::array<std::string_view, 3> kLineCommands = {"listen", "locate", "watch"};

/// Commands whose -o was the picture and is the report now.
constexpr std::array<std::string_view, 2> kPictureCommands = {"check-print", "replay"};

bool is_among(const auto& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// Rewrites the words of one command from its name on.
class Rewriter {
  public:
    explicit Rewriter(const std::vector<std::string>& words) : words_(words) {}

    Respelt operator()() {
        for (at_ = 0; at_ < words_.size(); ++at_) {
            if (words_[at_] == "--") break;
            if (at_ > 0 && (rename() || replace_flag() || replace_format() || move_picture()))
                continue;
            result_.words.push_back(words_[at_]);
        }
        result_.words.insert(result_.words.end(), words_.begin() + static_cast<std::ptrdiff_t>(at_),
                             words_.end());
        return result_;
    }

  private:
    std::string_view command() const { return words_.front(); }

    void note(std::string_view earlier, std::string_view now) {
        const std::string text = spelling_note(std::string(earlier), std::string(now));
        if (!is_among(result_.notes, text)) result_.notes.push_back(text);
    }

    bool rename() {
        const std::string& word = words_[at_];
        const std::string option = word.substr(0, word.find('='));
        for (const Renamed& renamed : kRenamed) {
            if (command() != renamed.command || option != renamed.earlier) continue;
            note(renamed.earlier, renamed.now);
            result_.words.push_back(std::string(renamed.now) + word.substr(option.size()));
            return true;
        }
        return false;
    }

    bool replace_flag() {
        for (const FormerFlag& former : kFormerFlags) {
            if (command() != former.command || words_[at_] != former.flag) continue;
            note(former.flag, std::string(former.option) + " " + std::string(former.value));
            result_.words.insert(result_.words.end(),
                                 {std::string(former.option), std::string(former.value)});
            return true;
        }
        return false;
    }

    bool replace_format() {
        if (!is_among(kLineCommands, command())) return false;
        const bool is_next_word =
            words_[at_] == "--format" && at_ + 1 < words_.size() && words_[at_ + 1] == "jsonl";
        if (!is_next_word && words_[at_] != "--format=jsonl") return false;
        note("--format jsonl", "--format json");
        result_.words.insert(result_.words.end(), {"--format", "json"});
        at_ += is_next_word ? 1 : 0;
        return true;
    }

    /// Turns -o PICTURE.svg into --draw PICTURE.svg.
    bool move_picture() {
        if (!is_among(kPictureCommands, command())) return false;
        const std::string_view word = words_[at_];
        std::string_view value;
        if ((word == "-o" || word == "--out") && at_ + 1 < words_.size()) {
            value = words_[at_ + 1];
        } else if (word.starts_with("--out=")) {
            value = word.substr(word.find('=') + 1);
        } else if (word.starts_with("-o") && !word.starts_with("-out")) {
            value = word.substr(2);
        }
        if (!value.ends_with(".svg")) return false;
        note("-o PICTURE.svg", "--draw PICTURE.svg");
        result_.words.insert(result_.words.end(), {"--draw", std::string(value)});
        at_ += word == "-o" || word == "--out" ? 1 : 0;
        return true;
    }

    const std::vector<std::string>& words_;
    std::size_t at_ = 0;
    Respelt result_;
};

}  // namespace

Respelt in_new_spelling(const std::vector<std::string>& words) {
    return Rewriter(words)();
}

std::string spelling_note(const std::string& earlier, const std::string& now) {
    return "note: " + earlier + " is now " + now +
           "; the earlier spelling works until the next release";
}

}  // namespace dotpose::cli

/// Checks InkML files against the W3C recommendation (Ink Markup Language, 20 September 2011).
/// Covers the elements that `dotpose ink` writes: their children, attributes and references, the
/// channels, and the values of the traces. XmlCheck checks that the XML is well-formed.
#pragma once

#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace dotpose::test {

class InkMlCheck {
  public:
    explicit InkMlCheck(const std::string& text) {
        static const std::regex tag(R"(<(/?)([A-Za-z]+)((?:\s+[\w:]+="[^"]*")*)\s*(/?)>)");
        std::size_t text_begin = 0;
        for (std::sregex_iterator it(text.begin(), text.end(), tag), end; it != end; ++it) {
            const std::smatch& match = *it;
            const auto at = static_cast<std::size_t>(match.position());
            if (match.str(1).empty()) {
                open(match.str(2), attributes_of(match.str(3)));
            } else if (match.str(2) == "trace") {
                check_trace(text.substr(text_begin, at - text_begin));
            }
            if (!match.str(1).empty() || !match.str(4).empty()) open_.pop_back();
            text_begin = at + static_cast<std::size_t>(match.length());
        }
        if (channels_.empty()) fail("no channels");
    }

    /// Returns the first fault, or an empty string if there is none.
    const std::string& problem() const { return problem_; }
    int traces() const { return traces_; }

  private:
    using Attributes = std::map<std::string, std::string>;

    struct Element {
        std::set<std::string> parents;
        std::set<std::string> required;
        std::set<std::string> optional;
    };

    struct Channel {
        double min;
        double max;
    };

    static const std::map<std::string, Element>& elements() {
        static const std::map<std::string, Element> kElements = {
            {"ink", {{""}, {"xmlns"}, {"documentID"}}},
            {"annotation", {{"ink"}, {}, {"type", "encoding"}}},
            {"definitions", {{"ink"}, {}, {}}},
            {"context", {{"ink", "definitions"}, {}, {"xml:id", "contextRef", "inkSourceRef"}}},
            {"inkSource",
             {{"context", "definitions"}, {"xml:id"}, {"manufacturer", "model", "description"}}},
            {"traceFormat", {{"inkSource", "context", "definitions"}, {}, {"xml:id"}}},
            {"channel",
             {{"traceFormat"},
              {"name"},
              {"type", "default", "min", "max", "orientation", "respectTo", "units"}}},
            {"trace",
             {{"ink", "traceGroup"},
              {},
              {"xml:id", "type", "continuation", "priorRef", "contextRef", "brushRef", "duration",
               "timeOffset"}}}};
        return kElements;
    }

    static Attributes attributes_of(const std::string& text) {
        static const std::regex attribute(R"re(([\w:]+)="([^"]*)")re");
        Attributes result;
        for (std::sregex_iterator it(text.begin(), text.end(), attribute), end; it != end; ++it)
            result[it->str(1)] = it->str(2);
        return result;
    }

    void fail(const std::string& problem) {
        if (problem_.empty()) problem_ = problem;
    }

    void open(const std::string& name, const Attributes& attributes) {
        const std::string parent = open_.empty() ? "" : open_.back();
        open_.push_back(name);
        const auto known = elements().find(name);
        if (known == elements().end()) return fail("unknown element " + name);
        const Element& element = known->second;
        if (!element.parents.contains(parent)) fail(name + " is in " + parent);
        for (const std::string& required : element.required)
            if (!attributes.contains(required)) fail(name + " has no " + required);
        for (const auto& [attribute, value] : attributes) {
            if (!element.required.contains(attribute) && !element.optional.contains(attribute))
                fail(name + " has " + attribute);
            if (attribute == "xml:id" && !ids_.insert(value).second) fail("two ids " + value);
            if (attribute == "xmlns" && value != "http://www.w3.org/2003/InkML")
                fail("wrong namespace " + value);
            if (attribute == "contextRef" && (value.empty() || !ids_.contains(value.substr(1))))
                fail("no context " + value);
        }
        if (name == "channel") add_channel(attributes);
    }

    void add_channel(const Attributes& attributes) {
        // Units that are allowed for each reserved channel name.
        static const std::set<std::string> kLengths = {"m", "cm", "mm", "in", "pt", "pc", "em"};
        static const std::set<std::string> kTimes = {"s", "ms"};
        static const std::set<std::string> kAngles = {"deg", "rad"};
        static const std::map<std::string, std::set<std::string>> kUnits = {
            {"X", kLengths}, {"Y", kLengths}, {"T", kTimes}, {"OTx", kAngles}, {"OTy", kAngles}};
        static const std::set<std::string> kTypes = {"integer", "decimal", "double", "boolean"};
        const auto value = [&](const char* name, const char* otherwise) {
            const auto found = attributes.find(name);
            return found == attributes.end() ? std::string(otherwise) : found->second;
        };
        const std::string name = value("name", "");
        const auto units = kUnits.find(name);
        if (units == kUnits.end()) return fail("unknown channel " + name);
        if (!units->second.contains(value("units", "none"))) fail("wrong units of " + name);
        if (!kTypes.contains(value("type", "decimal"))) fail("wrong type of " + name);
        channels_.push_back({std::strtod(value("min", "-1e300").c_str(), nullptr),
                             std::strtod(value("max", "1e300").c_str(), nullptr)});
    }

    /// Checks that each point has a decimal number for each channel, and that the number is within
    /// the range of the channel.
    void check_trace(const std::string& text) {
        ++traces_;
        static const std::regex separator(",");
        static const std::regex decimal(R"(-?(?:\d+(?:\.\d*)?|\.\d+))");
        static const std::regex space(R"(\s+)");
        const std::sregex_token_iterator end;
        for (std::sregex_token_iterator point(text.begin(), text.end(), separator, -1);
             point != end; ++point) {
            const std::string values = point->str();
            std::size_t count = 0;
            for (std::sregex_token_iterator it(values.begin(), values.end(), space, -1); it != end;
                 ++it) {
                if (it->length() == 0) continue;
                if (!std::regex_match(it->str(), decimal)) return fail("no decimal: " + it->str());
                if (count == channels_.size()) return fail("too many values: " + values);
                const double value = std::strtod(it->str().c_str(), nullptr);
                const Channel& channel = channels_[count++];
                if (value < channel.min || value > channel.max)
                    return fail("out of range: " + it->str());
            }
            if (count != channels_.size()) return fail("too few values: " + values);
        }
    }

    std::string problem_;
    int traces_ = 0;
    std::vector<std::string> open_;
    std::set<std::string> ids_;
    std::vector<Channel> channels_;
};

}  // namespace dotpose::test

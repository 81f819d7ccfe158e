/// Writes metrics in version 0.0.4 of the Prometheus text format.
#pragma once

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace dotpose::cli {

/// MIME type of the format.
inline constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

/// Collects metric samples. `begin` starts a metric, and the samples added next belong to it.
class MetricsText {
  public:
    void begin(std::string_view name, std::string_view type, std::string_view help) {
        name_ = name;
        fmt::format_to(std::back_inserter(text_), "# HELP {} {}\n# TYPE {} {}\n", name, help, name,
                       type);
    }
    /// Adds a sample. `labels` is a list such as `robot="anna"`, or empty.
    template <typename Value>
    void add(Value value, std::string_view labels = {}, std::string_view suffix = {}) {
        fmt::format_to(std::back_inserter(text_), "{}{}{}{}{} {}\n", name_, suffix,
                       labels.empty() ? "" : "{", labels, labels.empty() ? "" : "}", value);
    }
    template <typename Value>
    void gauge(std::string_view name, std::string_view help, Value value) {
        begin(name, "gauge", help);
        add(value);
    }
    template <typename Value>
    void counter(std::string_view name, std::string_view help, Value value) {
        begin(name, "counter", help);
        add(value);
    }
    std::string finish() && { return std::move(text_); }

  private:
    std::string name_;
    std::string text_;
};

/// Returns a label in the form name="value", with the value escaped.
std::string label(std::string_view name, std::string_view value);

}  // namespace dotpose::cli

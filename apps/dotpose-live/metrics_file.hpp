/// Writes metrics to a file for the textfile collector of Prometheus' node exporter.
#pragma once

#include <functional>
#include <string>

namespace dotpose::cli {

class MetricsFile {
  public:
    /// Throws Error if the file cannot be written.
    MetricsFile(std::string path, std::function<void(const std::string&)> tell);

    /// Replaces the file in one step, so that a reader never reads an incomplete file. If writing
    /// fails, reports this once and returns, because a later attempt may succeed.
    void write(const std::string& text);

  private:
    std::string path_;
    std::function<void(const std::string&)> tell_;
    bool is_failing_ = false;
};

}  // namespace dotpose::cli

/// A file of metrics for the textfile collector of Prometheus' node exporter.
#pragma once

#include <functional>
#include <string>

namespace dotpose::cli {

class MetricsFile {
  public:
    /// Throws Error if the file cannot be written.
    MetricsFile(std::string path, std::function<void(const std::string&)> tell);

    /// Replaces the contents in one step, so no reader sees a part of them. Reports the first of
    /// several failures and continues, because the next attempt may succeed.
    void write(const std::string& text);

  private:
    std::string path_;
    std::function<void(const std::string&)> tell_;
    bool is_failing_ = false;
};

}  // namespace dotpose::cli

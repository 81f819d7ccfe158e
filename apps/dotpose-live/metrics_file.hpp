/// Writes metrics to a file, for the textfile collector of the Prometheus node exporter.
#pragma once

#include <functional>
#include <string>

namespace dotpose::cli {

class MetricsFile {
  public:
    /// Throws Error if the file cannot be written.
    MetricsFile(std::string path, std::function<void(const std::string&)> notify);

    /// Replaces the file atomically, so a reader never sees an incomplete file. Does not throw if
    /// this fails, because later attempts may succeed. Reports only the first of several
    /// consecutive failures.
    void write(const std::string& text);

  private:
    std::string path_;
    std::function<void(const std::string&)> notify_;
    bool is_failing_ = false;
};

}  // namespace dotpose::cli

/// Publishes readings through a broker. Only dotpose-live connects to brokers. `dotpose` and
/// dotpose-live have different definitions of `open_publisher`.
#pragma once

#include <memory>
#include <string>

#include "mqtt_arguments.hpp"
#include "reading.hpp"

namespace dotpose::cli {

class ReadingSink {
  public:
    ReadingSink() = default;
    ReadingSink(const ReadingSink&) = delete;
    ReadingSink& operator=(const ReadingSink&) = delete;
    virtual ~ReadingSink() = default;

    virtual void take(const Reading& reading) = 0;
    /// Completes the output. Throws Error.
    virtual void finish() = 0;
};

/// Connects to the broker, or returns null without --mqtt. `sheets` is the path of the sheet file.
/// In `dotpose`, replaces this process with dotpose-live, with the same command line. Throws Error.
std::unique_ptr<ReadingSink> open_publisher(const PublishArguments& arguments,
                                            const std::string& sheets);

}  // namespace dotpose::cli

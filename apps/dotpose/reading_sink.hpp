/// Publishes readings through an MQTT broker or on a web page. The functions that open a sink are
/// implemented differently in `dotpose` and dotpose-live, because only dotpose-live can connect to
/// brokers and serve web pages.
#pragma once

#include <memory>
#include <string>

#include "mqtt_arguments.hpp"
#include "page_arguments.hpp"
#include "reading.hpp"

namespace dotpose::cli {

class ReadingSink {
  public:
    ReadingSink() = default;
    ReadingSink(const ReadingSink&) = delete;
    ReadingSink& operator=(const ReadingSink&) = delete;
    virtual ~ReadingSink() = default;

    virtual void take(const Reading& reading) = 0;
    /// Finishes the output. Throws Error on failure.
    virtual void finish() = 0;
};

/// Connects to the broker. In `dotpose`, which cannot connect, replaces this process with
/// dotpose-live instead, passing the same command line. `sheets` is the path of the sheet file.
/// Returns null if --mqtt is not given. Throws Error on failure.
std::unique_ptr<ReadingSink> open_publisher(const PublishArguments& arguments,
                                            const std::string& sheets);

/// Starts the web page of `listen` for a robot. Returns null if --web is not given. In `dotpose`,
/// replaces this process in the same way as `open_publisher`. Throws Error on failure.
std::unique_ptr<ReadingSink> open_page(const PageArguments& arguments, const std::string& robot,
                                       const std::string& sheets);

}  // namespace dotpose::cli

/// Publishes readings through a broker or in a page. Only dotpose-live connects to brokers and
/// serves pages. `dotpose` and dotpose-live have different definitions of the functions that open a
/// sink.
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
    /// Completes the output. Throws Error.
    virtual void finish() = 0;
};

/// Connects to the broker, or returns null without --mqtt. `sheets` is the path of the sheet file.
/// In `dotpose`, replaces this process with dotpose-live, with the same command line. Throws Error.
std::unique_ptr<ReadingSink> open_publisher(const PublishArguments& arguments,
                                            const std::string& sheets);

/// Starts the page of `listen` for a robot, or returns null without --web. Otherwise like
/// `open_publisher`.
std::unique_ptr<ReadingSink> open_page(const PageArguments& arguments, const std::string& robot,
                                       const std::string& sheets);

}  // namespace dotpose::cli

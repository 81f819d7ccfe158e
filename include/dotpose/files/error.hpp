/// Exceptions thrown by the layers around the core (printing, simulation, files, the command-line
/// tool). The core never throws. It returns a Status instead.
#pragma once

#include <stdexcept>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Thrown if an operation fails. `what()` is one sentence for the user, without a trailing full
/// stop. It contains the file name or the value that caused the error.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Thrown for an invalid argument, as opposed to a failure of a file or device. Examples are a
/// margin wider than the page and an unknown paper size. `what()` contains the invalid value and
/// the permitted values.
class BadArgument : public Error {
  public:
    using Error::Error;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

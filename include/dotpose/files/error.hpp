/// Errors of the layers around the core (printing, simulation, files, the tool). The core itself
/// never throws: it returns a Status.
#pragma once

#include <stdexcept>

#include "dotpose/language.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Thrown if something could not be done; `what()` is one sentence for the user, without a full
/// stop, that names the file or value concerned.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Thrown if the request itself cannot be met, whatever the state of the machine: a margin wider
/// than the page, an unknown paper size. `what()` says which value is wrong and what would be
/// right.
class BadArgument : public Error {
  public:
    using Error::Error;
};

}  // namespace dotpose

#pragma GCC visibility pop

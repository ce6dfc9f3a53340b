#pragma once

#include <stdexcept>

namespace ref_app {

// Something the user gave us cannot be used: a file, a folder, a size. what() is for people; the program ends
// with 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ref_app

#pragma once

#include <string>

namespace ref_app {

// The folder this program's file lies in: its sister programs and its module lie beside it.
std::string program_directory();

}  // namespace ref_app

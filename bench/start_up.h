// What `startup` measures: a process of its own that draws one textured frame and ends.
#pragma once

#include <string>

namespace halfspace::bench {

// The first argument that makes this program such a process; the library's path follows.
constexpr const char* kFirstFrame = "--first-frame";

void draw_first_frame(const std::string& library_path);

// The library whose start `startup` measures.
void set_start_up_library(const std::string& path);

}  // namespace halfspace::bench

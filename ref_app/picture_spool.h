// Finished pictures wait in a nameless temporary file until all is drawn and measured; only then are they
// encoded.
#pragma once

#include <cstdint>
#include <cstdio>
#include <vector>

#include "ref_app/gapi.h"

namespace ref_app {

class PictureSpool {
 public:
  PictureSpool();  // throws std::runtime_error when there is no room for a temporary file
  ~PictureSpool();
  PictureSpool(const PictureSpool&) = delete;
  PictureSpool& operator=(const PictureSpool&) = delete;

  // Reads the renderer's picture, a few rows at a time, so that it never lies in memory whole. Returns
  // whether every alpha is 255.
  bool store(Renderer& renderer);
  // The picture stored as the `index`-th, 0 first.
  Image fetch(size_t index);

 private:
  struct Entry {
    long offset;
    int width, height;
  };
  std::FILE* file_;
  std::vector<Entry> entries_;
};

}  // namespace ref_app

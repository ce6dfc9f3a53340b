// Image files, through OpenImageIO. It brings some 250 shared libraries and 100 MB along, so it lives in a
// module of its own that is loaded when the first file is read or written: what we measure before that is the
// renderer alone.
#pragma once

#include <string>

#include "ref_app/gapi.h"

namespace ref_app {

// Any size; grey, RGB or RGBA; sixteen bits and float become eight. Throws InputError.
Image load_image(const std::string& path);
// The extension chooses the format. Red, green and blue only, unless `with_alpha`. Throws std::runtime_error.
void save_image(const std::string& path, const Image& image, bool with_alpha = false);

// What the module exports, under the name ref_app_image_codec. The functions answer false and say why in
// `error`.
struct ImageCodec {
  bool (*load)(const std::string& path, Image& image, std::string& error);
  bool (*save)(const std::string& path, const Image& image, bool with_alpha, std::string& error);
};

}  // namespace ref_app

// The images and the model the scenes are made of: computed, or read from a folder that replaces them.
#pragma once

#include <string>

#include "ref_app/teapot.h"

namespace ref_app {

class Assets {
 public:
  // `directory`: where to look for brick, wood, marble, checker, height and terrain, as .png, .bmp, .jpg,
  // .tif or .tga; what is not there is computed. Empty: everything is. `model`: an OBJ file in place of the
  // teapot, or empty. Throws InputError when the directory or the model does not exist.
  Assets(std::string directory, std::string model);

  // Textures come with sides that are powers of two, at most 2048, as OpenGL 1.1 asks.
  Image brick() const;
  Image wood() const;
  Image marble() const;
  Image checker() const;
  Image height_map() const;
  Image terrain_texture(const Image& heights) const;
  Geometry teapot(const TeapotLook& look) const;

  // Writes all images to `directory` as PNG, under the names above.
  void write(const std::string& directory) const;

 private:
  bool load_replacement(const std::string& name, Image& image) const;
  std::string directory_, model_;
};

}  // namespace ref_app

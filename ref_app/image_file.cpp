#include "ref_app/image_file.h"

#include <dlfcn.h>

#include "ref_app/input_error.h"
#include "ref_app/program_path.h"

namespace ref_app {
namespace {

const ImageCodec& codec() {
  static const ImageCodec* const loaded = [] {
    const std::string path = program_directory() + "/ref_app_image_codec.so";
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) throw std::runtime_error(std::string("cannot load the image module: ") + dlerror());
    const void* symbol = dlsym(module, "ref_app_image_codec");
    if (!symbol) throw std::runtime_error(path + " is not the image module");
    return static_cast<const ImageCodec*>(symbol);
  }();
  return *loaded;
}

}  // namespace

Image load_image(const std::string& path) {
  Image image;
  std::string error;
  if (!codec().load(path, image, error)) throw InputError("cannot read the image " + path + ": " + error);
  return image;
}

void save_image(const std::string& path, const Image& image, bool with_alpha) {
  std::string error;
  if (!codec().save(path, image, with_alpha, error)) {
    throw std::runtime_error("cannot write the image " + path + ": " + error);
  }
}

}  // namespace ref_app

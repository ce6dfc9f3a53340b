#include "ref_app/assets.h"

#include <filesystem>
#include <system_error>

#include "ref_app/image_file.h"
#include "ref_app/input_error.h"
#include "ref_app/model_file.h"
#include "ref_app/terrain.h"
#include "ref_app/textures.h"

namespace ref_app {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestTexture = 2048;

// The power of two that is nearest to `size` from below, up to the largest.
int texture_side(int size) {
  int side = 1;
  while (side * 2 <= size && side < kLargestTexture) side *= 2;
  return side;
}

// Each new texel is the mean of the old ones under it; sizes only shrink.
Image shrink(const Image& image, int width, int height) {
  Image out{width, height,
            std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height) * 4)};
  for (int y = 0; y < height; ++y) {
    const int y0 = y * image.height / height, y1 = (y + 1) * image.height / height;
    for (int x = 0; x < width; ++x) {
      const int x0 = x * image.width / width, x1 = (x + 1) * image.width / width;
      for (int channel = 0; channel < 4; ++channel) {
        int sum = 0;
        for (int v = y0; v < y1; ++v) {
          for (int u = x0; u < x1; ++u)
            sum += image.rgba[static_cast<size_t>((v * image.width + u) * 4 + channel)];
        }
        const int count = (x1 - x0) * (y1 - y0);
        out.rgba[static_cast<size_t>((y * width + x) * 4 + channel)] =
            static_cast<uint8_t>((sum + count / 2) / count);
      }
    }
  }
  return out;
}

}  // namespace

Assets::Assets(std::string directory, std::string model)
    : directory_(std::move(directory)), model_(std::move(model)) {
  std::error_code ignored;
  if (!directory_.empty() && !fs::is_directory(directory_, ignored)) {
    throw InputError("there is no folder " + directory_);
  }
  if (!model_.empty()) load_model(model_, {});  // complain before anything is drawn
}

bool Assets::load_replacement(const std::string& name, Image& image) const {
  if (directory_.empty()) return false;
  for (const char* extension : {".png", ".bmp", ".jpg", ".tif", ".tga"}) {
    const fs::path path = fs::path(directory_) / (name + extension);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) continue;
    image = load_image(path.string());
    const int width = texture_side(image.width), height = texture_side(image.height);
    if (width != image.width || height != image.height) image = shrink(image, width, height);
    return true;
  }
  return false;
}

Image Assets::brick() const {
  Image image;
  return load_replacement("brick", image) ? image : make_brick();
}
Image Assets::wood() const {
  Image image;
  return load_replacement("wood", image) ? image : make_wood();
}
Image Assets::marble() const {
  Image image;
  return load_replacement("marble", image) ? image : make_marble();
}
Image Assets::checker() const {
  Image image;
  return load_replacement("checker", image) ? image : make_checker();
}
Image Assets::height_map() const {
  Image image;
  return load_replacement("height", image) ? image : make_height_map();
}
Image Assets::terrain_texture(const Image& heights) const {
  Image image;
  return load_replacement("terrain", image) ? image : make_terrain_texture(heights);
}

Geometry Assets::teapot(const TeapotLook& look) const {
  return model_.empty() ? make_teapot(look) : load_model(model_, look);
}

void Assets::write(const std::string& directory) const {
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (failure) throw InputError("cannot make the folder " + directory + ": " + failure.message());
  const auto save = [&](const char* name, const Image& image) {
    save_image((fs::path(directory) / (std::string(name) + ".png")).string(), image);
  };
  save("brick", brick());
  save("wood", wood());
  save("marble", marble());
  save("checker", checker());
  const Image heights = height_map();
  save("height", heights);
  save("terrain", terrain_texture(heights));
}

}  // namespace ref_app

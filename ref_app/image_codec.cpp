// The image module: image_file.h says why it stands alone.
#include <OpenImageIO/imageio.h>

#include <exception>

#include "ref_app/image_file.h"

namespace ref_app {
namespace {

constexpr int kLargestSide = 16384;  // pixels; more is a broken header, or no texture

// Files begin with the top row, images here with the bottom one.
void flip_rows(std::vector<uint8_t>& pixels, size_t row_bytes) {
  const size_t rows = row_bytes ? pixels.size() / row_bytes : 0;
  for (size_t low = 0, high = rows; low + 1 < high; ++low) {
    --high;
    std::swap_ranges(&pixels[low * row_bytes], &pixels[low * row_bytes] + row_bytes,
                     &pixels[high * row_bytes]);
  }
}

void expand_to_rgba(const std::vector<uint8_t>& pixels, size_t channels, Image& image) {
  const size_t count = pixels.size() / channels;
  image.rgba.resize(count * 4);
  for (size_t i = 0; i < count; ++i) {
    const uint8_t* p = &pixels[i * channels];
    uint8_t* out = &image.rgba[i * 4];
    const bool grey = channels < 3;
    out[0] = p[0], out[1] = grey ? p[0] : p[1], out[2] = grey ? p[0] : p[2];
    out[3] = channels == 2 ? p[1] : (channels >= 4 ? p[3] : uint8_t{255});
  }
}

bool load_file(const std::string& path, Image& image, std::string& error) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) {
    error = OIIO::geterror();
    return false;
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide ||
      spec.depth > 1 || spec.nchannels < 1) {
    error = "its size is " + std::to_string(spec.width) + "x" + std::to_string(spec.height);
    return false;
  }
  const auto channels = static_cast<size_t>(spec.nchannels < 4 ? spec.nchannels : 4);
  image.width = spec.width, image.height = spec.height;
  const size_t row_bytes = static_cast<size_t>(spec.width) * channels;
  std::vector<uint8_t> pixels(row_bytes * static_cast<size_t>(spec.height));
  if (!input->read_image(0, 0, 0, static_cast<int>(channels), OIIO::TypeDesc::UINT8, pixels.data())) {
    error = input->geterror();
    return false;
  }
  flip_rows(pixels, row_bytes);
  expand_to_rgba(pixels, channels, image);
  return true;
}

bool save_file(const std::string& path, const Image& image, bool with_alpha, std::string& error) {
  const auto output = OIIO::ImageOutput::create(path);
  if (!output) {
    error = OIIO::geterror();
    return false;
  }
  const size_t channels = with_alpha ? 4 : 3, count = image.rgba.size() / 4;
  std::vector<uint8_t> pixels(count * channels);
  for (size_t i = 0; i < count; ++i) std::copy_n(&image.rgba[i * 4], channels, &pixels[i * channels]);
  flip_rows(pixels, static_cast<size_t>(image.width) * channels);
  const OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(channels), OIIO::TypeDesc::UINT8);
  if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) ||
      !output->close()) {
    error = output->geterror();
    return false;
  }
  return true;
}

// No exception crosses the module's border.
template <typename Call>
bool guarded(std::string& error, Call call) {
  try {
    return call();
  } catch (const std::exception& failure) {
    error = failure.what();
    return false;
  }
}

bool load(const std::string& path, Image& image, std::string& error) {
  return guarded(error, [&] { return load_file(path, image, error); });
}
bool save(const std::string& path, const Image& image, bool with_alpha, std::string& error) {
  return guarded(error, [&] { return save_file(path, image, with_alpha, error); });
}

}  // namespace
}  // namespace ref_app

extern "C" __attribute__((visibility("default")))
const ref_app::ImageCodec ref_app_image_codec{&ref_app::load, &ref_app::save};

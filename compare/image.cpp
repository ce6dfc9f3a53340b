#include "compare/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace halfspace::compare {
namespace {

constexpr int kLargestSide = 1 << 16;

std::unique_ptr<OIIO::ImageInput> open_input(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw ImageError(path.string() + ": no such file");
  // OpenImageIO multiplies colours by alpha on reading unless told not to; levels would be lost.
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(path.string(), &config);
  if (!input) throw ImageError(path.string() + ": cannot be read as a picture: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels < 1 || spec.nchannels > 4)
    throw ImageError(path.string() + ": has " + std::to_string(spec.nchannels) +
                     " channels; 1 to 4 are known");
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide)
    throw ImageError(path.string() + ": has an impossible size");
  return input;
}

// All samples in levels. Eight-bit files are read as bytes, so that whole levels stay whole.
std::vector<float> read_levels(OIIO::ImageInput& input, const std::filesystem::path& path) {
  const OIIO::ImageSpec& spec = input.spec();
  const size_t count = static_cast<size_t>(spec.image_pixels()) * static_cast<size_t>(spec.nchannels);
  std::vector<float> levels(count);
  bool good = false;
  if (spec.format == OIIO::TypeDesc::UINT8) {
    std::vector<uint8_t> bytes(count);
    good = input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, bytes.data());
    std::transform(bytes.begin(), bytes.end(), levels.begin(),
                   [](uint8_t v) { return static_cast<float>(v); });
  } else {
    good = input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, levels.data());
    for (float& level : levels) level *= 255.0f;
  }
  if (!good) throw ImageError(path.string() + ": is damaged: " + input.geterror());
  return levels;
}

Pixel expand(const float* sample, int channels) {
  switch (channels) {
    case 1:
      return {sample[0], sample[0], sample[0], 255};
    case 2:
      return {sample[0], sample[0], sample[0], sample[1]};
    case 3:
      return {sample[0], sample[1], sample[2], 255};
    default:
      return {sample[0], sample[1], sample[2], sample[3]};
  }
}

uint8_t to_byte(float level) {
  if (!(level > 0)) return 0;  // also not-a-number
  return static_cast<uint8_t>(std::lround(std::min(level, 255.0f)));
}

std::vector<uint8_t> to_bytes(const Image& image) {
  const size_t channels = image.has_alpha ? 4 : 3;
  std::vector<uint8_t> bytes(image.pixels.size() * channels);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (size_t c = 0; c < channels; ++c) bytes[i * channels + c] = to_byte(image.pixels[i][c]);
  return bytes;
}

void write_image(OIIO::ImageOutput& output, const Image& image, const std::string& name) {
  OIIO::ImageSpec spec(image.width, image.height, image.has_alpha ? 4 : 3, OIIO::TypeDesc::UINT8);
  spec["oiio:UnassociatedAlpha"] = 1;
  const std::vector<uint8_t> bytes = to_bytes(image);
  if (!output.open(name, spec) || !output.write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !output.close())
    throw ImageError(name + ": cannot be written: " + output.geterror());
}

}  // namespace

Image load_image(const std::filesystem::path& path) {
  const auto input = open_input(path);
  const OIIO::ImageSpec& spec = input->spec();
  const std::vector<float> levels = read_levels(*input, path);
  Image image(spec.width, spec.height);
  image.has_alpha = spec.nchannels == 2 || spec.nchannels == 4;
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = expand(&levels[i * static_cast<size_t>(spec.nchannels)], spec.nchannels);
  return image;
}

void save_image(const Image& image, const std::filesystem::path& path) {
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output)
    throw ImageError(path.string() + ": no picture format is known by this extension; try .png or .bmp");
  write_image(*output, image, path.string());
}

std::vector<uint8_t> encode_png(const Image& image) {
  const auto output = OIIO::ImageOutput::create("picture.png");
  if (!output) throw ImageError("OpenImageIO has no PNG writer; install libopenimageio2.4 with PNG support");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  write_image(*output, image, "picture.png");
  return {bytes.begin(), bytes.end()};
}

Image crop_around(const Image& image, int x, int y, int size) {
  const int width = std::min(size, image.width);
  const int height = std::min(size, image.height);
  const int left = std::clamp(x - width / 2, 0, image.width - width);
  const int top = std::clamp(y - height / 2, 0, image.height - height);
  Image crop(width, height);
  crop.has_alpha = image.has_alpha;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) crop.at(column, row) = image.at(left + column, top + row);
  return crop;
}

}  // namespace halfspace::compare
